// The npm package in node:  node test_module.mjs .../npm/index.mjs
import assert from 'node:assert/strict';
import { pathToFileURL } from 'node:url';

const { loadPliant } = await import(pathToFileURL(process.argv[2]));
const pliant = await loadPliant();

const drop = JSON.stringify({
  pliant: 1,
  bodies: [{ name: 'sheet', mesh: { shape: 'grid', columns: 4, rows: 4 }, mass: { total: 1 },
             constraints: [{ type: 'edge_spring', name: 'threads', stiffness: 1e3 }] }],
});

function open(text) {
  const scene = pliant.openScene(text, 'test', '');
  scene.look(1.5);
  return scene;
}
function steps(scene, count) {
  for (let i = 0; i < count; ++i) scene.step();
}
const place = (scene, vertex) => [...scene.frame().positions.slice(3 * vertex, 3 * vertex + 3)];
const near = (a, b, within) => assert.ok(a.every((x, i) => Math.abs(x - b[i]) <= within), `${a} is not ${b}`);

const tests = {
  async 'says what is missing where there are no vectors'() {
    const { validate } = WebAssembly;
    try {
      WebAssembly.validate = () => false;
      const { loadPliant: loadAgain } = await import(pathToFileURL(process.argv[2]));
      await assert.rejects(loadAgain(), /no vectors of WebAssembly.*Chrome 95/);
    } finally {
      WebAssembly.validate = validate;
    }
  },

  'colors show values of the corners'() {
    const scene = open(drop);
    assert.equal(scene.frame().values, null);
    assert.equal(scene.frame('none').values, null);
    steps(scene, 10);
    const { numbers, low, high } = scene.frame('speed').values;
    assert.equal(numbers.length, 16);
    // All fall alike: v = g h n
    const speed = 9.81 * scene.timeStep() * 10;
    for (const number of numbers) assert.ok(Math.abs(number - speed) < 1e-4);
    assert.ok(low === 0 && high >= speed && high < 10 * speed);
    const stretch = scene.frame('stretch').values;
    assert.equal(stretch.low, -stretch.high);
    for (const number of stretch.numbers) assert.ok(Math.abs(number) < 1e-5);
    assert.throws(() => scene.frame('taste'), /'taste' is none of none, stretch/);
    const maps = pliant.colorMaps();
    assert.deepEqual(maps.map((map) => map.name), ['stretch', 'energy', 'speed', 'gap', 'contact_force']);
    for (const { tones, title } of maps) assert.ok(tones.length >= 6 && tones.length % 3 === 0 && title.includes('['));
    for (const { name } of maps) assert.equal(scene.frame(name).values.numbers.length, 16);
    scene.delete();
  },

  'free fall is that of implicit Euler'() {
    const scene = open(drop);
    const before = scene.frame().positions;
    steps(scene, 10);
    const h = scene.timeStep();
    const { positions } = scene.frame();
    assert.equal(positions.length, 3 * 16);
    // z after n steps: -g h² n (n + 1) / 2
    const fall = 9.81 * h * h * 10 * 11 / 2;
    for (let v = 0; v < 16; ++v) assert.ok(Math.abs(before[3 * v + 2] - positions[3 * v + 2] - fall) < 1e-6);
    assert.ok(Math.abs(scene.time() - 10 * h) < 1e-12);
    scene.restart(true);
    assert.equal(scene.time(), 0);
    scene.look(1.5);
    assert.deepEqual(scene.frame().positions, before);
    scene.delete();
  },

  'a pinned vertex stays, follows its pin, and falls when it is let go'() {
    const scene = open(drop);
    const start = place(scene, 0);
    scene.pin(0);
    assert.deepEqual([...scene.frame().pins], [0]);
    steps(scene, 20);
    assert.deepEqual(place(scene, 0), start);
    scene.unpin(0);
    steps(scene, 20);
    assert.ok(place(scene, 0)[2] < start[2] - 0.01);
    scene.pin(0);
    scene.movePin(0, 1, 2, 3);
    scene.step();
    assert.deepEqual(place(scene, 0), [1, 2, 3]);
    scene.delete();
  },

  'a pin that is moved before the first step begins there'() {
    const scene = open(drop);
    scene.pin(0);
    scene.movePin(0, 0, 0, 2);
    scene.dropPin(0);
    steps(scene, 3);
    scene.restart(true);
    scene.look(1.5);
    scene.step();
    near(place(scene, 0), [0, 0, 2], 1e-6);
    scene.delete();
  },

  'a spring draws a point to where its end is'() {
    const scene = open(drop);
    const key = scene.parameters().find((each) => each.option === 'acceleration').key;
    scene.set(key, 0, 0, 0, false);
    scene.grab([5, 6, 9], [0.5, 0.25, 0.25], 0, 0, 1, 1e6);
    steps(scene, 40);
    near(scene.frame().pull.from, [0, 0, 1], 0.02);
    scene.pullTo(0, 0, 2);
    steps(scene, 40);
    near(scene.frame().pull.from, [0, 0, 2], 0.02);
    assert.deepEqual(scene.frame().pull.to, [0, 0, 2]);
    scene.letGo();
    assert.equal(scene.frame().pull, null);
    scene.delete();
  },

  'options are listed, set, taken back and done again'() {
    const scene = open(drop);
    const stiffness = () => scene.parameters().find((each) => each.heading.includes('threads') && each.option === 'stiffness');
    assert.deepEqual(stiffness().value, [1000]);
    assert.equal(stiffness().unit, 'N/m');
    scene.set(stiffness().key, 250, 0, 0, false);
    scene.set(stiffness().key, 260, 0, 0, true);
    assert.deepEqual(stiffness().value, [260]);
    assert.equal(scene.undoneNext(), 'threads: stiffness');
    scene.undo();
    assert.deepEqual(stiffness().value, [1000]);
    scene.redo();
    assert.deepEqual(stiffness().value, [260]);
    assert.throws(() => scene.set(stiffness().key, -1, 0, 0, false), /stiffness/);
    assert.deepEqual(stiffness().value, [260]);
    scene.delete();
  },

  'a scene that was changed is written, and read again to the same bits'() {
    const scene = open(pliant.builtinScene('towel'));
    scene.setMaterial(scene.materials()[0].body, 'silk');
    scene.pin(0);
    const again = open(scene.text());
    assert.equal(again.materials()[0].material, 'silk');
    assert.equal(again.hasChanges(), false);
    scene.restart(true);
    scene.look(1.5);
    steps(scene, 3);
    steps(again, 3);
    assert.deepEqual(again.frame().positions, scene.frame().positions);
    assert.deepEqual(again.frame().pins, scene.frame().pins);
    scene.delete();
    again.delete();
  },

  'what is wrong is said as in the program'() {
    assert.throws(() => open('{'), (error) => error instanceof Error && /^test:1:/.test(error.message));
    assert.throws(() => open(drop.replace('edge_spring', 'edge_sprin')), /did you mean 'edge_spring' or/);
    assert.throws(() => pliant.builtinScene('nothing'), /no built-in scene 'nothing'/);
    const scene = open(drop);
    assert.throws(() => scene.pin(16), /there is no vertex 16/);
    assert.throws(() => scene.pin(-1), /there is no vertex -1/);
    assert.throws(() => scene.pin(NaN), /there is no vertex/);
    assert.throws(() => scene.grab([0, 1, 99], [1, 0, 0], 0, 0, 0, 1), /vertex 99/);
    assert.throws(() => scene.setMaterial('sheet', 'cottn'), /cotton/);
    assert.throws(() => scene.setMaterial('shirt', 'cotton'), /no body 'shirt'/);
    scene.step();
    scene.delete();
  },

  'meshes are read from memory, in every way that they are written'() {
    const bytes = (text) => new TextEncoder().encode(text);
    const square = 'v 0 0 0\nv 0.5 0 0\nv 0.5 0 1\nv 0 0 1\n';
    pliant.writeFile('/files/a/square.obj', bytes(`${square}f 1 2 3 4\n`));
    const cloth = pliant.openMesh('/files/a/square.obj', 1, 'z');
    assert.equal(cloth.look(1).vertexCount, 4);
    assert.equal(cloth.name(), 'square');
    steps(cloth, 5);
    const scene = pliant.openScene(cloth.text(), 'saved', '/files/a');
    assert.equal(scene.look(1).vertexCount, 4);
    // A binary STL with one triangle, all bytes of which may be anything.
    const stl = new Uint8Array(84 + 50);
    const numbers = new DataView(stl.buffer);
    numbers.setUint32(80, 1, true);
    [0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0].forEach((x, i) => numbers.setFloat32(84 + 4 * i, x, true));
    pliant.writeFile('/files/b/one.stl', stl);
    const one = pliant.openMesh('/files/b/one.stl', 1, 'y');
    assert.equal(one.look(1).vertexCount, 3);
    pliant.writeFile('/files/c/broken.obj', bytes('v 0 0\n'));
    assert.throws(() => pliant.openMesh('/files/c/broken.obj', 1, 'z'), /broken\.obj:1: /);
    assert.throws(() => pliant.openMesh('/files/c/none.obj', 1, 'z'), /none\.obj/);
    assert.throws(() => pliant.openMesh('/files/a/square.obj', 1, 'up'), /up is 'x', 'y' or 'z'/);
    for (const each of [cloth, scene, one]) each.delete();
  },

  'every built-in scene opens, and can be drawn'() {
    const names = pliant.builtinScenes().map((each) => each.name);
    assert.ok(names.length > 30);
    for (const name of names) {
      const scene = pliant.openScene(pliant.builtinScene(name), name, '');
      const look = scene.look(16 / 9);
      const corners = look.vertexCount + look.copies.length;
      const frame = scene.frame();
      assert.equal(frame.positions.length, 3 * corners, name);
      assert.equal(frame.normals.length, 3 * corners, name);
      for (const colors of [look.front, look.back, look.second]) assert.equal(colors.length, 4 * corners, name);
      assert.equal(look.places.length, 3 * corners, name);
      assert.ok(look.triangles.every((corner) => corner < corners), name);
      assert.ok(look.ropes.every((vertex) => vertex < look.vertexCount), name);
      assert.ok(look.triangles.length + look.ropes.length > 0, name);
      assert.equal(frame.poses.length, 7 * look.colliders.length, name);
      assert.deepEqual(frame.colliders, look.colliders.map((each) => each.number), name);
      assert.ok(look.radius > 0 && look.viewpoint.eye.every(Number.isFinite), name);
      scene.delete();
    }
  },
};

for (const [name, test] of Object.entries(tests)) {
  await test();
  console.log(`ok: ${name}`);
}
