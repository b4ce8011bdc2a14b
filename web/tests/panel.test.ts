import { describe, expect, it } from 'vitest';
import { rounded, scaleOf } from '../page/range';
import { addWind } from '../page/scene_text';

describe('the scale of a slider', () => {
  it('has all of a small range', () => {
    const scale = scaleOf({ kind: 'real', min: 0, max: 1 }, 0.25);
    expect(scale?.valueAt(0)).toBe(0);
    expect(scale?.valueAt(1)).toBe(1);
    expect(scale?.placeOf(0.25)).toBeCloseTo(0.25);
  });

  it('has two orders of magnitude on each side of a stiffness, and zero', () => {
    const scale = scaleOf({ kind: 'real', min: 0, max: Infinity }, 1000);
    expect(scale?.valueAt(0)).toBe(0);
    expect(scale?.valueAt(1)).toBeCloseTo(1e5);
    for (const value of [10, 77, 1000, 5e4]) expect(scale?.valueAt(scale.placeOf(value))).toBeCloseTo(value);
  });

  it('keeps to the ends of the range', () => {
    const scale = scaleOf({ kind: 'integer', min: 1, max: 100_000 }, 20);
    expect(scale?.valueAt(0)).toBe(1);
    expect(scale?.valueAt(1)).toBeCloseTo(2000);
    expect(scaleOf({ kind: 'real', min: 1e-6, max: 10_000 }, 500)?.valueAt(1)).toBeCloseTo(10_000);
  });

  it('takes places past its ends as the ends', () => {
    const scale = scaleOf({ kind: 'real', min: 0, max: 1e9 }, 1);
    expect(scale?.placeOf(1e12)).toBe(1);
    expect(scale?.placeOf(0)).toBe(0);
  });

  it('is none for numbers of both signs without end, and for what is no number', () => {
    expect(scaleOf({ kind: 'real', min: -Infinity, max: Infinity }, 3)).toBeNull();
    expect(scaleOf({ kind: 'vector', min: -1, max: 1 }, 0)).toBeNull();
    expect(scaleOf({ kind: 'real', min: 0, max: Infinity }, NaN)).toBeNull();
  });

  it('sets numbers that one would set by hand', () => {
    expect(rounded(1234.56)).toBe(1230);
    expect(rounded(0.0012346)).toBe(0.00123);
    expect(rounded(Infinity)).toBe(Infinity);
  });
});

describe('a wind', () => {
  it('is added to the forces that there are', () => {
    const scene = JSON.parse(addWind('{"pliant": 1, "forces": [{"type": "gravity"}]}')) as { forces: { type: string }[] };
    expect(scene.forces.map((force) => force.type)).toEqual(['gravity', 'wind']);
    expect(JSON.parse(addWind('{"pliant": 1}'))).toHaveProperty('forces.0.type', 'wind');
  });
});
