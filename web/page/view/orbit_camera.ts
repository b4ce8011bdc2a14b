// A camera that orbits what it looks at, as apps/viewer/orbit_camera.cpp does; up stays up.
import { Camera } from 'three';
import type { Vec3, Viewpoint } from '../protocol';
import { add, clamp, cross, dot, length, subtract, times, turn, unit } from './vectors';
import type { Box } from './vectors';

const turnAHeight = 1.2 * Math.PI, tiltAHeight = 0.7 * Math.PI;
const steepest = 0.49 * Math.PI;    // of the view, from the horizon [rad]
const clearance = 0.02;             // of the distance, over the floor
const leastDistance = 1e-4, largestDistance = 1e7;  // [m]
/** Width over height that viewpoints are made for, and the least of a picture for which the eye stays there. */
const usualAspect = 16 / 9, leastAspect = 1.2;
/** Of the picture, that may be filled where the eye moves back for a narrow one. */
const filled = 0.92;

export interface PictureSize {
  /** CSS pixels. */
  width: number;
  height: number;
  /** Of the width, free at the right for a panel. */
  inset: number;
}

export interface Ray {
  origin: Vec3;
  /** So long that it gets 1 m farther into the picture. */
  along: Vec3;
}

export class OrbitCamera {
  readonly camera = new Camera();
  private home: Viewpoint = { eye: [0, -3, 1], target: [0, 0, 0], up: [0, 0, 1], fieldOfView: 35 };
  private eye: Vec3 = this.home.eye;
  private target: Vec3 = this.home.target;
  private up: Vec3 = [0, 0, 1];
  private axis: Vec3 = [0, 0, 1];
  private size: PictureSize = { width: 1, height: 1, inset: 0 };
  /** The user has not moved it yet. */
  private isHome = true;
  /** How many times as far back as the viewpoint it stands. */
  private back = 1;

  constructor() {
    this.camera.matrixAutoUpdate = this.camera.matrixWorldAutoUpdate = false;
  }

  get position(): Vec3 {
    return this.eye;
  }

  get forward(): Vec3 {
    return unit(subtract(this.target, this.eye));
  }

  /** keeps: where it stands; only `goHome` goes to the new viewpoint. */
  begin(viewpoint: Viewpoint, keeps: boolean): void {
    this.home = viewpoint;
    if (keeps) return;
    this.axis = unit(viewpoint.up);
    this.isHome = true;
  }

  /** Where the scene wants it; so far back that all points fit that a picture of the usual shape has. */
  goHome(points: Vec3[], isAsked: boolean): void {
    if (isAsked) this.isHome = true;
    if (!this.isHome) return;
    this.back = this.backward(points);
    this.place();
  }

  /** The scene moves it, until the user does. */
  follow(viewpoint: Viewpoint): void {
    this.home = viewpoint;
    if (this.isHome) this.place();
  }

  resize(size: PictureSize): void {
    this.size = size;
  }

  /** By CSS pixels to the right and down. The eye does not go below the floor, unless it is there already. */
  orbit(dx: number, dy: number, floor: number | null): void {
    const forward = this.forward;
    const height = Math.asin(clamp(-dot(forward, this.axis), -1, 1));
    const distance = this.distance;
    let lowest = -steepest;
    if (floor !== null) {
      const below = (floor - dot(this.target, this.axis)) / Math.max(distance, leastDistance);
      lowest = Math.max(lowest, Math.asin(clamp(below + clearance, -1, 1)));
    }
    lowest = Math.min(lowest, height);
    const tilted = clamp(height + (dy / this.size.height) * tiltAHeight, lowest, Math.max(steepest, height));
    const moved = (v: Vec3): Vec3 =>
      turn(turn(v, this.right, height - tilted), this.axis, -(dx / this.size.height) * turnAHeight);
    const newForward = unit(moved(forward));
    const newUp = moved(this.up);
    this.eye = subtract(this.target, times(distance, newForward));
    this.up = unit(subtract(newUp, times(dot(newUp, newForward), newForward)));
    this.isHome = false;
  }

  /** Points at the depth of the target stay under the mouse. */
  pan(dx: number, dy: number): void {
    const scale = (2 * this.distance * this.slope) / this.size.height;
    const shift = add(times(scale * dy, this.up), times(-scale * dx, this.right));
    this.eye = add(this.eye, shift);
    this.target = add(this.target, shift);
    this.isHome = false;
  }

  /** Multiplies the distance from the target. */
  zoom(factor: number): void {
    if (!(factor > 0)) return;
    const distance = clamp(this.distance * factor, leastDistance, largestDistance);
    this.eye = subtract(this.target, times(distance, this.forward));
    this.isHome = false;
  }

  viewpoint(): Viewpoint {
    return { eye: [...this.eye], target: [...this.target], up: [...this.axis], fieldOfView: this.home.fieldOfView };
  }

  depthOf(point: Vec3): number {
    return dot(subtract(point, this.eye), this.forward);
  }

  /** Through a place in CSS pixels. */
  rayAt(x: number, y: number): Ray {
    const { width, height, inset } = this.size;
    const scale = this.slope / height;
    const right = times(scale * (2 * x - (width - inset)), this.right);
    return { origin: this.eye, along: add(add(this.forward, right), times(scale * (height - 2 * y), this.up)) };
  }

  /** Where a point is in CSS pixels, and how deep; null: behind the eye. */
  placeOf(point: Vec3): { x: number; y: number; depth: number } | null {
    const depth = this.depthOf(point);
    if (!(depth > 0)) return null;
    const away = subtract(point, this.eye);
    const { width, height, inset } = this.size;
    const scale = height / (2 * this.slope * depth);
    const x = (width - inset) / 2 + scale * dot(away, this.right);
    return { x, y: height / 2 - scale * dot(away, this.up), depth };
  }

  /** Makes the matrices of three.js. Returns where near and far are [m]. */
  prepare(bounds: Box): { near: number; far: number } {
    const { width, height, inset } = this.size;
    const forward = this.forward, right = this.right, up = this.up, eye = this.eye;
    const radius = Math.max(bounds.radius, 1e-3);
    const distance = length(subtract(bounds.center, eye));
    const far = distance + 30 * radius;
    // So near that no floor under the eye is cut off.
    const near = 2e-3 * Math.max(distance, radius);
    const { camera, slope } = this;
    camera.matrixWorld.set(right[0], up[0], -forward[0], eye[0], right[1], up[1], -forward[1], eye[1],
                           right[2], up[2], -forward[2], eye[2], 0, 0, 0, 1);
    camera.matrixWorldInverse.copy(camera.matrixWorld).invert();
    camera.projectionMatrix.set(height / width / slope, 0, inset / width, 0, 0, 1 / slope, 0, 0,
                                0, 0, (far + near) / (near - far), (2 * far * near) / (near - far), 0, 0, -1, 0);
    camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
    return { near, far };
  }

  private place(): void {
    const { eye, target, up } = this.home;
    const forward = unit(subtract(target, eye));
    this.target = target;
    this.up = cross(unit(cross(forward, up)), forward);
    this.eye = subtract(target, times(this.back * length(subtract(target, eye)), forward));
  }

  private get distance(): number {
    return length(subtract(this.target, this.eye));
  }

  private get right(): Vec3 {
    return unit(cross(this.forward, this.up));
  }

  /** Half the height of the picture at a depth of 1. */
  private get slope(): number {
    return Math.tan((this.home.fieldOfView * Math.PI) / 360);
  }

  /**
   * What multiplies the distance of the viewpoint where less than the usual width is free: so much that the points fit
   * that the usual picture has, and somewhat more for what moves.
   */
  private backward(points: Vec3[]): number {
    const { width, height, inset } = this.size;
    const free = Math.max(width - inset, 1) / height, usual = Math.max(width / height, usualAspect);
    if (free >= usual) return 1;
    const { eye, target, up } = this.home;
    const distance = length(subtract(target, eye));
    const forward = unit(subtract(target, eye)), side = unit(cross(forward, up));
    let most = Math.max(1, Math.sqrt(leastAspect / free));
    for (const point of points) {
      const away = subtract(point, eye);
      const depth = dot(away, forward), across = Math.abs(dot(away, side));
      if (depth <= 0 || across > usual * this.slope * depth) continue;
      most = Math.max(most, 1 + (across / (filled * free * this.slope) - depth) / distance);
    }
    return Math.min(most, usual / free);
  }
}
