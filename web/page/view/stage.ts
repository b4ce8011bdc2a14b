// The picture of a scene: what is drawn, from where, and what is under the mouse.
import type { ColorMap, Frame, SceneLook, Vec3, Viewpoint } from '../protocol';
import { CanvasSize } from './canvas_size';
import { OrbitCamera } from './orbit_camera';
import { Painter } from './painter';
import { Picker, positionOf } from './picking';
import type { Picked } from './picking';
import { pointOf } from './vectors';

export type { Picked } from './picking';

export class Stage {
  /** The graphics driver has taken the picture away, and gives it back later. */
  onLost: (() => void) | null = null;
  onRestored: (() => void) | null = null;

  /** Whether what is seen can be touched. */
  canPick = true;

  private readonly painter: Painter;
  private readonly size: CanvasSize;
  private readonly camera = new OrbitCamera();
  private readonly picker = new Picker(this.camera);
  private look: SceneLook | null = null;
  private frame_: Frame | null = null;
  private bright: Picked | null = null;
  private inset = 0;
  /** Another frame; only another view of it. */
  private hasNewFrame = false;
  private isDirty = true;
  /** The camera shall go to where all is in the picture. */
  private goesHome = true;
  private lastCall = 0;
  /** How long the last picture took, until the page asked for the next [ms]. */
  private lastInterval = 0;
  private hasJustDrawn = false;

  constructor(canvas: HTMLCanvasElement) {
    this.painter = new Painter(canvas, {
      lost: () => this.onLost?.(),
      restored: () => {
        this.hasNewFrame = this.isDirty = true;
        this.onRestored?.();
      },
    });
    this.size = new CanvasSize(canvas, () => {
      this.goesHome = this.isDirty = true;
    });
  }

  /** Of `full`, `medium`, `low` and `lowest`. It goes down by itself where pictures take too long. */
  get quality(): string {
    return this.painter.quality.level.name;
  }

  set quality(name: string) {
    this.painter.quality.choose(name);
    this.hasNewFrame = this.isDirty = true;
  }

  /** What is in the memory of the graphics card, for tests. */
  get memory(): { geometries: number; textures: number; programs: number } {
    return this.painter.memory;
  }

  /** Shows another scene, from its first frame on. */
  show(look: SceneLook, keepsCamera: boolean): void {
    this.look = look;
    this.frame_ = null;
    this.bright = null;
    this.camera.begin(look.viewpoint, keepsCamera);
    if (!keepsCamera) this.painter.quality.forget();
    this.painter.show(look);
    this.goesHome = this.isDirty = true;
  }

  /** Frames of another scene than the one shown are left out. */
  update(frame: Frame): void {
    const { look } = this;
    if (look === null || frame.positions.length !== 3 * (look.vertexCount + look.copies.length)) return;
    this.frame_ = frame;
    if (frame.viewpoint !== null) this.camera.follow(frame.viewpoint);
    this.hasNewFrame = this.isDirty = true;
  }

  /** Once for each picture of the screen. Does nothing where all is as it was; says whether it has drawn. */
  draw(): boolean {
    const now = performance.now();
    if (this.hasJustDrawn) this.lastInterval = now - this.lastCall;
    this.lastCall = now;
    this.hasJustDrawn = false;
    // Until the first frame of a scene comes, the picture of the one before stays.
    const isWaiting = this.look !== null && this.frame_ === null;
    if (!this.isDirty || isWaiting || this.painter.isLost) return false;
    this.takeSize();
    this.painter.resize(this.size.width, this.size.height);
    if (this.frame_ !== null && this.hasNewFrame) this.painter.update(this.frame_);
    if (this.frame_ !== null && this.goesHome) {
      this.camera.goHome(this.painter.outline(), false);
      this.goesHome = false;
    }
    this.painter.highlight(this.brightPlace(), this.bright?.kind === 'pin');
    this.painter.draw(this.camera, this.frame_ !== null);
    this.hasNewFrame = this.isDirty = false;
    this.hasJustDrawn = true;
    return true;
  }

  /** The time from picture to picture while things move; waiting for the simulation does not count [ms]. */
  noteInterval(milliseconds: number): void {
    if (this.lastInterval === 0) return;
    if (this.painter.quality.note(Math.min(milliseconds, this.lastInterval))) this.hasNewFrame = this.isDirty = true;
  }

  /** What is at a place, in CSS pixels. reach: around a pin, that counts as the pin. */
  pick(x: number, y: number, reach = 9): Picked | null {
    if (this.look === null || this.frame_ === null || !this.canPick) return null;
    this.takeSize();
    const { positions, pins } = this.frame_;
    return this.picker.pick(x, y, reach, this.look, positions, pins, this.painter.solids);
  }

  /** The point under a place that is as deep in the picture as another. */
  pointAt(x: number, y: number, like: Vec3): Vec3 {
    this.takeSize();
    const { origin, along } = this.camera.rayAt(x, y);
    const depth = this.camera.depthOf(like);
    return [origin[0] + depth * along[0], origin[1] + depth * along[1], origin[2] + depth * along[2]];
  }

  /** Where a vertex is, in CSS pixels; outside of the picture where it is not seen. */
  placeOf(vertex: number): { x: number; y: number } {
    this.takeSize();
    const place = this.frame_ === null ? null : this.camera.placeOf(pointOf(this.frame_.positions, vertex));
    return place === null ? { x: -1, y: -1 } : { x: place.x, y: place.y };
  }

  /** By CSS pixels to the right and down, as the next. */
  orbit(dx: number, dy: number): void {
    this.camera.orbit(dx, dy, this.painter.floor);
    this.isDirty = true;
  }

  pan(dx: number, dy: number): void {
    this.camera.pan(dx, dy);
    this.isDirty = true;
  }

  /** Multiplies the distance. */
  zoom(factor: number): void {
    this.camera.zoom(factor);
    this.isDirty = true;
  }

  /** Back to where the scene wants the camera. */
  frame(): void {
    this.takeSize();
    this.camera.goHome(this.painter.outline(), true);
    this.isDirty = true;
  }

  viewpoint(): Viewpoint {
    return this.camera.viewpoint();
  }

  /** CSS pixels at the right that something else covers. */
  setInset(pixels: number): void {
    if (pixels === this.inset) return;
    this.inset = pixels;
    this.goesHome = this.isDirty = true;
  }

  setDark(dark: boolean): void {
    this.painter.isDark = dark;
    this.hasNewFrame = this.isDirty = true;
  }

  /** Of the values that frames have. */
  setColors(map: ColorMap): void {
    this.painter.setColors(map);
  }

  setWireframe(on: boolean): void {
    this.painter.setWireframe(on);
    this.isDirty = true;
  }

  /** Lights up what would be grabbed. */
  highlight(picked: Picked | null): void {
    if (picked === null && this.bright === null) return;
    this.bright = picked;
    this.isDirty = true;
  }

  dispose(): void {
    this.size.dispose();
    this.painter.dispose();
  }

  private takeSize(): void {
    const { width, height } = this.size;
    this.camera.resize({ width, height, inset: Math.min(this.inset, 0.8 * width) });
  }

  /** It moves with what it is on. */
  private brightPlace(): Vec3 | null {
    const { bright, frame_ } = this;
    if (bright === null || frame_ === null) return null;
    if (bright.kind === 'pin') return pointOf(frame_.positions, bright.vertex);
    return bright.kind === 'body' ? positionOf(bright.point, frame_.positions) : bright.position;
  }
}
