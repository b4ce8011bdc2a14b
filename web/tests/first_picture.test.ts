// The file of the first picture against what the simulation makes of the scene now.
import { readFile } from 'node:fs/promises';
import { describe, expect, it } from 'vitest';
import { loadPliant } from 'pliant';
import { firstPictureFile, readFirstPicture } from '../page/first_picture';
import { firstScene } from '../page/gallery';
import { pack, unpack } from '../page/packed';
import type { Report } from '../page/protocol';
import { Simulator } from '../page/simulator';

type Of<T extends Report['type']> = Extract<Report, { type: T }>;

const pliant = await loadPliant();

/** What the worker tells of the scene before its first step. */
async function firstReports(aspect: number): Promise<{ opened: Of<'opened'>; frame: Of<'frame'> }> {
  const reports: Report[] = [];
  const simulator = new Simulator(pliant, (report) => reports.push(report));
  simulator.command({ type: 'open', id: 1, source: { kind: 'builtin', name: firstScene }, aspect });
  const of = <T extends Report['type']>(type: T): Of<T> | undefined =>
    reports.find((report): report is Of<T> => report.type === type);
  for (let i = 0; i < 500 && of('frame') === undefined; ++i) await new Promise((resolve) => setTimeout(resolve, 10));
  simulator.command({ type: 'play', on: false }, 1);
  const opened = of('opened'), frame = of('frame');
  if (opened === undefined || frame === undefined) throw new Error('nothing came');
  return { opened, frame };
}

describe('the first picture', () => {
  it('is that of the simulation, whatever the shape of the page', async () => {
    const file = await readFile(new URL(`../dist/${firstPictureFile}`, import.meta.url));
    const first = readFirstPicture(new Uint8Array(file).buffer);
    for (const aspect of [1.2, 16 / 9, 2.4]) {
      const { opened, frame } = await firstReports(aspect);
      expect(first.name).toBe(opened.name);
      expect(first.description).toBe(opened.description);
      expect(frame.statistics.time).toBe(0);
      expect(first.frame).toEqual(frame.frame);
      const { colliders, ...look } = first.look;
      const { colliders: truth, ...wanted } = opened.look;
      expect(look).toEqual(wanted);
      expect(colliders.length).toBe(truth.length);
      colliders.forEach((collider, i) => {
        const { normals, ...rest } = collider;
        const { normals: exact = new Float32Array(), ...wantedRest } = truth[i]!;
        expect(rest).toEqual(wantedRest);
        expect(normals.length).toBe(exact.length);
        const farthest = normals.reduce((most, x, k) => Math.max(most, Math.abs(x - exact[k]!)), 0);
        expect(farthest).toBeLessThan(1e-3);
      });
    }
  }, 240_000);  // a minute on a busy machine
});

describe('a packed file', () => {
  it('holds what was put into it', () => {
    const value = { text: 'ü', list: [1, null, { deep: new Uint8Array([1, 2, 3]) }],
                    numbers: new Float32Array([0.1, -2, Infinity]), corners: new Uint32Array([7, 3, 4_000_000_000, 0]),
                    none: new Float32Array() };
    const file = pack(value);
    expect(unpack(file.slice().buffer)).toEqual(value);
    expect(value.corners[1]).toBe(3);
  });

  it('refuses arrays that it cannot hold', () => {
    expect(() => pack({ wide: new Float64Array(2) })).toThrow('no file holds a Float64Array');
  });
});
