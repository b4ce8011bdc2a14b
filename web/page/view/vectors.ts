// Points and directions in space.
import type { Vec3 } from '../protocol';

export const add = (a: Vec3, b: Vec3): Vec3 => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const times = (s: number, a: Vec3): Vec3 => [s * a[0], s * a[1], s * a[2]];
export const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const length = (a: Vec3): number => Math.hypot(a[0], a[1], a[2]);
export const clamp = (x: number, low: number, high: number): number => Math.min(Math.max(x, low), high);

export function cross(a: Vec3, b: Vec3): Vec3 {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/** Of length 1; straight up where there is no direction. */
export function unit(a: Vec3): Vec3 {
  const size = length(a);
  return size > 0 ? times(1 / size, a) : [0, 0, 1];
}

/** Turns a direction by an angle about an axis of length 1. */
export function turn(a: Vec3, axis: Vec3, angle: number): Vec3 {
  const cosine = Math.cos(angle);
  const along = times((1 - cosine) * dot(axis, a), axis);
  return add(add(times(cosine, a), times(Math.sin(angle), cross(axis, a))), along);
}

/** Point number `i` of an array with three numbers for each. */
export function pointOf(points: ArrayLike<number>, i: number): Vec3 {
  return [points[3 * i] ?? 0, points[3 * i + 1] ?? 0, points[3 * i + 2] ?? 0];
}

/** The box around points, in axes of the caller's choice. */
export class Box {
  readonly low: Vec3 = [Infinity, Infinity, Infinity];
  readonly high: Vec3 = [-Infinity, -Infinity, -Infinity];

  get isEmpty(): boolean {
    return !(this.high[0] >= this.low[0]);
  }

  get center(): Vec3 {
    return this.isEmpty ? [0, 0, 0] : times(0.5, add(this.low, this.high));
  }

  /** Half the length of the diagonal. */
  get radius(): number {
    return this.isEmpty ? 0 : length(subtract(this.high, this.low)) / 2;
  }

  /** Points that are nowhere, as of a simulation that has failed, are left out. */
  add(x: number, y: number, z: number): void {
    if (!Number.isFinite(x + y + z)) return;
    const { low, high } = this;
    if (x < low[0]) low[0] = x;
    if (y < low[1]) low[1] = y;
    if (z < low[2]) low[2] = z;
    if (x > high[0]) high[0] = x;
    if (y > high[1]) high[1] = y;
    if (z > high[2]) high[2] = z;
  }

  addAll(points: Float32Array): void {
    for (let i = 0; i + 2 < points.length; i += 3) this.add(points[i]!, points[i + 1]!, points[i + 2]!);
  }

  corners(): Vec3[] {
    const { low, high } = this;
    const at = (number: number): Vec3 => [
      number & 1 ? high[0] : low[0], number & 2 ? high[1] : low[1], number & 4 ? high[2] : low[2],
    ];
    return this.isEmpty ? [] : [0, 1, 2, 3, 4, 5, 6, 7].map(at);
  }
}
