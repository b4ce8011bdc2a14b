// The module for browsers, in node:  node test_module.mjs pliant.mjs
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const { default: createPliant } = await import(pathToFileURL(process.argv[2]));
// Emscripten 3.1.6 would fetch it, and node's fetch takes no paths.
const wasmBinary = readFileSync(process.argv[2].replace(/mjs$/, 'wasm'));
const pliant = await createPliant({ wasmBinary });

const drop = JSON.stringify({
  pliant: 1,
  bodies: [{ mesh: { shape: 'grid', columns: 4, rows: 4 }, mass: { total: 1 },
             constraints: [{ type: 'edge_spring', name: 'threads', stiffness: 1e3 }] }],
});

function open(text) {
  return new pliant.Scene(text, 'test');
}

const tests = {
  'free fall is that of implicit Euler'() {
    const scene = open(drop);
    const before = scene.positions().slice();
    const steps = 10;
    for (let i = 0; i < steps; ++i) scene.step();
    const h = scene.timeStep();
    const after = scene.positions();
    assert.equal(after.length, 3 * 16);
    // z after n steps: -g h² n (n + 1) / 2
    const fall = 9.81 * h * h * steps * (steps + 1) / 2;
    for (let v = 0; v < 16; ++v) assert.ok(Math.abs(before[3 * v + 2] - after[3 * v + 2] - fall) < 1e-9);
    assert.ok(Math.abs(scene.time() - steps * h) < 1e-12);
    scene.delete();
  },

  'a pinned vertex stays, follows its pin, and falls when it is let go'() {
    const scene = open(drop);
    const start = scene.positions().slice(0, 3);
    scene.pin(0);
    for (let i = 0; i < 20; ++i) scene.step();
    assert.deepEqual(scene.positions().slice(0, 3), start);
    scene.unpin(0);
    for (let i = 0; i < 20; ++i) scene.step();
    assert.ok(scene.positions()[2] < start[2] - 0.01);
    scene.pin(0);
    scene.movePin(0, 1, 2, 3);
    scene.step();
    assert.deepEqual([...scene.positions().slice(0, 3)], [1, 2, 3]);
    scene.unpin(0);
    assert.throws(() => scene.movePin(0, 0, 0, 0), /has no pin/);
    scene.delete();
  },

  'a spring draws a vertex to where its end is'() {
    const scene = open(drop);
    scene.set('gravity', 'acceleration', 0, 0, 0);
    scene.grab(5, 1e6, 0, 0, 1);
    scene.step();
    assert.ok(Math.abs(scene.positions()[3 * 5 + 2] - 1) < 0.01);
    scene.pullTo(0, 0, 2);
    scene.step();
    assert.ok(Math.abs(scene.positions()[3 * 5 + 2] - 2) < 0.01);
    scene.letGo();
    scene.delete();
  },

  'options are listed, and set'() {
    const scene = open(drop);
    const stiffness = () => scene.parameters().find((p) => p.owner === 'threads' && p.option === 'stiffness');
    assert.deepEqual(stiffness().value, [1000]);
    assert.equal(stiffness().unit, 'N/m');
    scene.set('threads', 'stiffness', 250, 0, 0);
    assert.deepEqual(stiffness().value, [250]);
    scene.set('', 'iterations', 3, 0, 0);
    assert.deepEqual(scene.parameters().find((p) => p.owner === '' && p.option === 'iterations').value, [3]);
    assert.throws(() => scene.set('threads', 'stiffness', -1, 0, 0), /stiffness/);
    assert.throws(() => scene.set('threads', 'color', 1, 0, 0), /no option 'color'/);
    scene.delete();
  },

  'what is wrong with a scene is said as in the program'() {
    assert.throws(() => open('{'), (error) => error instanceof Error && /^test:1:/.test(error.message));
    assert.throws(() => open(drop.replace('edge_spring', 'edge_sprin')), /did you mean 'edge_spring' or/);
    assert.throws(() => pliant.builtinScene('nothing'), /no built-in scene 'nothing'/);
    const scene = open(drop);
    assert.throws(() => scene.pin(16), /out of range; the scene has 16/);
    scene.delete();
  },

  'built-in scenes open, and have surfaces'() {
    assert.ok(pliant.builtinSceneNames().length > 30);
    const scene = open(pliant.builtinScene('torus'));
    const triangles = scene.triangles();
    const vertices = scene.positions().length / 3;
    assert.ok(triangles.length > 0 && triangles.length % 3 === 0);
    assert.ok(triangles.every((v) => v >= 0 && v < vertices));
    scene.step();
    assert.ok(scene.positions().every(Number.isFinite));
    scene.delete();
  },
};

for (const [name, test] of Object.entries(tests)) {
  test();
  console.log(`ok: ${name}`);
}
