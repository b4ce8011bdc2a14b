// What is under the mouse, as apps/viewer/picking.cpp finds it.
import { Matrix4 } from 'three';
import type { SceneLook, SurfacePoint, Vec3 } from '../protocol';
import { moved } from './colliders';
import type { PlacedCollider } from './colliders';
import type { OrbitCamera, Ray } from './orbit_camera';
import { add, clamp, length, pointOf, subtract, times } from './vectors';

export type Picked =
  | { kind: 'pin'; vertex: number; position: Vec3 }
  /** nearest: of the three vertices. */
  | { kind: 'body'; point: SurfacePoint; nearest: number; position: Vec3 }
  /** grip: from the place where it is taken to the origin of its frame. */
  | { kind: 'collider'; number: number; position: Vec3; grip: Vec3 };

/** CSS pixels around a rope that count as the rope. */
const ropeReach = 7;
const slack = 1e-9;
/** A pin at least as much deeper than the surface is behind it. */
const nearly = 1.02;

interface Hit {
  /** Which triangle. */
  number: number;
  /** In lengths of the ray's direction. */
  way: number;
  /** Shares of its second and third corner. */
  v: number;
  w: number;
}

/**
 * The first triangle that a ray meets, after Möller and Trumbore (1997). corners: three for each triangle; null: the
 * points are the corners.
 */
export function meet(ray: Ray, points: Float32Array, corners: Uint32Array | null): Hit | null {
  const [ox, oy, oz] = ray.origin, [dx, dy, dz] = ray.along;
  const count = corners === null ? points.length / 3 : corners.length;
  const best: Hit = { number: -1, way: Infinity, v: 0, w: 0 };
  for (let t = 0; t + 2 < count; t += 3) {
    const a = 3 * (corners === null ? t : corners[t]!), b = 3 * (corners === null ? t + 1 : corners[t + 1]!);
    const c = 3 * (corners === null ? t + 2 : corners[t + 2]!);
    const ax = points[a]!, ay = points[a + 1]!, az = points[a + 2]!;
    const bx = points[b]! - ax, by = points[b + 1]! - ay, bz = points[b + 2]! - az;
    const cx = points[c]! - ax, cy = points[c + 1]! - ay, cz = points[c + 2]! - az;
    const nx = dy * cz - dz * cy, ny = dz * cx - dx * cz, nz = dx * cy - dy * cx;
    const determinant = bx * nx + by * ny + bz * nz;
    if (!(Math.abs(determinant) > 0)) continue;
    const fx = ox - ax, fy = oy - ay, fz = oz - az;
    const v = (fx * nx + fy * ny + fz * nz) / determinant;
    if (!(v >= -slack && v <= 1 + slack)) continue;
    const px = fy * bz - fz * by, py = fz * bx - fx * bz, pz = fx * by - fy * bx;
    const w = (dx * px + dy * py + dz * pz) / determinant;
    if (!(w >= -slack && v + w <= 1 + slack)) continue;
    const way = (cx * px + cy * py + cz * pz) / determinant;
    if (!(way > 0 && way < best.way)) continue;
    best.number = t / 3;
    best.way = way;
    best.v = clamp(v, 0, 1);
    best.w = clamp(w, 0, 1 - best.v);
  }
  return best.number < 0 ? null : best;
}

/** Where a point of a body is. */
export function positionOf(point: SurfacePoint, positions: Float32Array): Vec3 {
  return point.vertices.reduce<Vec3>((sum, vertex, i) => add(sum, times(point.weights[i]!, pointOf(positions, vertex))),
                                     [0, 0, 0]);
}

interface Found {
  picked: Picked;
  depth: number;
}

export class Picker {
  constructor(private readonly camera: OrbitCamera) {}

  /** reach: CSS pixels around a pin that count as the pin. */
  pick(x: number, y: number, reach: number, look: SceneLook, positions: Float32Array, pins: Uint32Array,
       solids: PlacedCollider[]): Picked | null {
    const ray = this.camera.rayAt(x, y);
    const surface = this.pickTriangle(ray, look, positions);
    const body = this.pickRope(x, y, look, positions, surface?.depth ?? Infinity) ?? surface;
    const collider = this.pickCollider(ray, solids);
    const bodyDepth = body?.depth ?? Infinity, colliderDepth = collider?.depth ?? Infinity;
    const pin = this.pickPin(x, y, reach, positions, pins);
    if (pin !== null && pin.depth <= nearly * Math.min(bodyDepth, colliderDepth)) return pin.picked;
    const foremost = bodyDepth <= colliderDepth ? body : collider;
    return foremost?.picked ?? null;
  }

  private found(point: SurfacePoint, positions: Float32Array, depth: number): Found {
    const position = positionOf(point, positions);
    const distance = (vertex: number): number => length(subtract(pointOf(positions, vertex), position));
    const nearest = point.vertices.reduce((a, b) => (distance(b) < distance(a) ? b : a));
    return { picked: { kind: 'body', point, nearest, position }, depth };
  }

  private pickTriangle(ray: Ray, look: SceneLook, positions: Float32Array): Found | null {
    const hit = meet(ray, positions, look.triangles);
    if (hit === null) return null;
    const vertex = (corner: number): number => {
      const number = look.triangles[3 * hit.number + corner]!;
      return number < look.vertexCount ? number : look.copies[number - look.vertexCount]!;
    };
    const weights: SurfacePoint['weights'] = [1 - hit.v - hit.w, hit.v, hit.w];
    return this.found({ vertices: [vertex(0), vertex(1), vertex(2)], weights }, positions, hit.way);
  }

  private pickRope(x: number, y: number, look: SceneLook, positions: Float32Array, before: number): Found | null {
    let best: { point: SurfacePoint; depth: number } | null = null;
    for (let i = 0; i + 1 < look.ropes.length; i += 2) {
      const first = look.ropes[i]!, second = look.ropes[i + 1]!;
      const a = this.camera.placeOf(pointOf(positions, first)), b = this.camera.placeOf(pointOf(positions, second));
      if (a === null || b === null) continue;
      const alongX = b.x - a.x, alongY = b.y - a.y;
      const square = alongX * alongX + alongY * alongY;
      const seen = square > 0 ? clamp(((x - a.x) * alongX + (y - a.y) * alongY) / square, 0, 1) : 0;
      if (Math.hypot(a.x + seen * alongX - x, a.y + seen * alongY - y) > ropeReach) continue;
      // Nearer ends look longer.
      const weight = seen / b.depth;
      const share = weight / (weight + (1 - seen) / a.depth);
      const depth = (1 - share) * a.depth + share * b.depth;
      if (depth >= (best?.depth ?? before)) continue;
      best = { point: { vertices: [first, second, second], weights: [1 - share, share, 0] }, depth };
    }
    return best === null ? null : this.found(best.point, positions, best.depth);
  }

  private pickCollider(ray: Ray, solids: PlacedCollider[]): Found | null {
    let best: Found | null = null;
    for (const { look, place } of solids) {
      if (!look.isMovable) continue;
      const toFrame = new Matrix4().copy(place).invert();
      const origin = moved(toFrame, ray.origin);
      const along = subtract(moved(toFrame, add(ray.origin, ray.along)), origin);
      const hit = meet({ origin, along }, look.positions, null);
      if (hit === null || hit.way >= (best?.depth ?? Infinity)) continue;
      const position = add(ray.origin, times(hit.way, ray.along));
      const grip = subtract(moved(place, [0, 0, 0]), position);
      best = { picked: { kind: 'collider', number: look.number, position, grip }, depth: hit.way };
    }
    return best;
  }

  private pickPin(x: number, y: number, reach: number, positions: Float32Array, pins: Uint32Array): Found | null {
    let best: Found | null = null;
    let nearest = reach;
    for (const vertex of pins) {
      const position = pointOf(positions, vertex);
      const place = this.camera.placeOf(position);
      if (place === null) continue;
      const distance = Math.hypot(place.x - x, place.y - y);
      if (distance > nearest) continue;
      nearest = distance;
      best = { picked: { kind: 'pin', vertex, position }, depth: place.depth };
    }
    return best;
  }
}
