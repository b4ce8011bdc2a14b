// Draws a scene with three.js: maps of shadows where something has moved, and the picture.
import { Color, ColorManagement, LinearSRGBColorSpace, WebGLRenderer } from 'three';
import type { ColorMap, Frame, SceneLook, Vec3 } from '../protocol';
import { Bodies } from './bodies';
import { Colliders, moved } from './colliders';
import type { PlacedCollider } from './colliders';
import { Marks } from './dots';
import { Floors } from './floors';
import type { FloorTones } from './floors';
import { Blur } from './floor_shadow';
import { Layers, SharedUniforms } from './layers';
import { Lines } from './lines';
import type { OrbitCamera } from './orbit_camera';
import { isSoftware, Quality } from './quality';
import { ShadowMap } from './shadow_map';
import { Box, pointOf, unit } from './vectors';
import { setbackOf } from './setback';

/** Towards the eye, of the radius of the scene, for lines on what they lie on. */
const lift = 1.5e-3;
const defaultBackground: Vec3 = [0.93, 0.94, 0.95];
const darkBackground: Vec3 = [0.114, 0.129, 0.145];

interface Listeners {
  lost(): void;
  restored(): void;
}

/** What draws here: the graphics card, or the processor in its place. */
function rendererName(): string {
  const gl = document.createElement('canvas').getContext('webgl2');
  if (gl === null) throw new Error('this browser offers no WebGL 2, which draws the picture');
  const info = gl.getExtension('WEBGL_debug_renderer_info');
  const name: unknown = gl.getParameter(info?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER);
  gl.getExtension('WEBGL_lose_context')?.loseContext();
  return String(name);
}

export class Painter {
  readonly quality: Quality;
  isDark = false;

  private readonly renderer: WebGLRenderer;
  private readonly shared = new SharedUniforms();
  private readonly layers = new Layers();
  private readonly bodies = new Bodies(this.layers, this.shared);
  private readonly colliders = new Colliders(this.layers, this.shared);
  private readonly lines = new Lines(this.layers, this.shared);
  private readonly marks = new Marks(this.layers, this.shared);
  private readonly floors = new Floors(this.layers, this.shared);
  private readonly shadowMap = new ShadowMap(this.shared);
  private blur: Blur | null = null;
  private look: SceneLook | null = null;
  private positions: Float32Array = new Float32Array();
  private bounds = new Box();
  private ground: number | null = null;
  /** Of colliders [m]; NaN: not known before the first frame. */
  private setback = NaN;
  private needsShadows = false;
  private size = '';

  constructor(private readonly canvas: HTMLCanvasElement, listeners: Listeners) {
    const name = rendererName();
    this.quality = new Quality(name);
    ColorManagement.enabled = false;
    this.renderer = new WebGLRenderer({ canvas, antialias: !isSoftware(name), alpha: false, stencil: false });
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.renderer.sortObjects = false;
    canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      listeners.lost();
    });
    canvas.addEventListener('webglcontextrestored', () => {
      this.needsShadows = true;
      listeners.restored();
    });
  }

  get isLost(): boolean {
    return this.renderer.getContext().isContextLost();
  }

  get memory(): { geometries: number; textures: number; programs: number } {
    const { memory, programs } = this.renderer.info;
    return { geometries: memory.geometries, textures: memory.textures, programs: programs?.length ?? 0 };
  }

  get solids(): PlacedCollider[] {
    return this.colliders.solids;
  }

  /** What the eye stays above; null: there is none. */
  get floor(): number | null {
    const flat = this.colliders.planes.filter((each) => each.place.elements[10] > 0.999);
    if (flat.length > 0) return Math.max(...flat.map((each) => each.place.elements[14]));
    return this.ground;
  }

  show(look: SceneLook): void {
    this.look = look;
    this.setback = NaN;
    this.bounds = new Box();
    this.positions = new Float32Array();
    this.bodies.show(look);
    this.colliders.show(look.colliders);
    this.lines.show(look);
    this.marks.clear();
    this.shared.light.value.set(...unit(look.light));
  }

  update(frame: Frame): void {
    if (this.look === null) return;
    this.positions = frame.positions;
    this.ground = this.look.ground === null ? null : frame.ground;
    if (Number.isNaN(this.setback)) this.setback = setbackOf(this.look, frame.positions);
    this.bodies.update(frame);
    this.colliders.update(frame);
    this.lines.update(frame);
    this.marks.update(frame);
    this.bounds = new Box();
    this.bounds.addAll(frame.positions);
    for (const corner of this.colliderCorners()) this.bounds.add(...corner);
    this.needsShadows = true;
  }

  setColors(map: ColorMap): void {
    this.bodies.setColors(map);
  }

  setWireframe(on: boolean): void {
    this.bodies.setWireframe(on);
  }

  /** Points that are about as far out as the scene is. */
  outline(): Vec3[] {
    const count = this.positions.length / 3;
    const step = Math.max(Math.floor(count / 2000), 1);
    const points = this.colliderCorners();
    for (let i = 0; i < count; i += step) points.push(pointOf(this.positions, i));
    return points;
  }

  highlight(at: Vec3 | null, isPin: boolean): void {
    this.marks.highlight(at, isPin);
  }

  /** In CSS pixels. */
  resize(width: number, height: number): void {
    const ratio = Math.min(window.devicePixelRatio, this.quality.level.pixelRatio);
    const size = `${width} ${height} ${ratio}`;
    if (size === this.size || this.isLost) return;
    this.size = size;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.shared.pixelRatio.value = ratio;
    this.shared.picture.value.set(this.canvas.width, this.canvas.height);
  }

  /** hasFrame: otherwise only the background is drawn. */
  draw(camera: OrbitCamera, hasFrame: boolean): void {
    const background = this.background();
    if (hasFrame && this.needsShadows) this.drawShadows(camera, background);
    const { near, far } = camera.prepare(this.bounds);
    const depth = Math.max(camera.depthOf(this.bounds.center), near);
    const shift = (2 * far * near) / ((far - near) * depth * depth);
    this.shared.eye.value.set(...camera.position);
    this.shared.setback.value = (this.setback || 0) * shift;
    this.shared.lift.value = lift * this.bounds.radius * shift;
    this.lines.prepare();
    this.marks.prepare();
    this.floors.prepare(camera.position);
    this.layers.picture.visible = hasFrame;
    this.renderer.setRenderTarget(null);
    this.renderer.setClearColor(new Color(...background), 1);
    this.renderer.render(this.layers.picture, camera.camera);
  }

  dispose(): void {
    const { bodies, colliders, lines, marks, floors, shadowMap } = this;
    for (const each of [bodies, colliders, lines, marks, floors, shadowMap]) each.dispose();
    this.blur?.dispose();
    this.renderer.dispose();
  }

  private drawShadows(camera: OrbitCamera, background: Vec3): void {
    const { renderer, layers, bounds } = this;
    const light = this.shared.light.value.toArray();
    const level = this.quality.level;
    this.shared.taps.value = level.taps;
    this.bodies.hasShadows = this.colliders.hasShadows = level.shadowMap > 0 && !bounds.isEmpty;
    this.shadowMap.draw(renderer, layers, camera.camera, level.shadowMap, bounds, light, this.setback);
    this.blur ??= new Blur(camera.camera);
    this.floors.update(this.colliders.planes, this.ground, bounds, light, this.floorTones(background));
    this.floors.drawShadows(renderer, this.blur, level.mask, this.positions, this.solids);
    this.needsShadows = false;
  }

  private background(): Vec3 {
    const own = this.look?.background ?? defaultBackground;
    const isDefault = own.every((x, i) => Math.abs(x - defaultBackground[i]!) < 0.004);
    return this.isDark && isDefault ? darkBackground : own;
  }

  private floorTones(background: Vec3): FloorTones {
    const isDark = background === darkBackground;
    const share = isDark ? 1.42 : 0.86;
    const tone = background.map((x) => x * share) as Vec3;
    return { background, tone, shadow: isDark ? 0.52 : 0.34 };
  }

  private colliderCorners(): Vec3[] {
    return this.solids.flatMap(({ box, place }) => box.corners().map((corner) => moved(place, corner)));
  }
}
