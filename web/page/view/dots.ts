// Pins, the end of a pull, and what lights up under the mouse.
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Points, Vector3 } from 'three';
import type { RawShaderMaterial } from 'three';
import type { Frame, Vec3 } from '../protocol';
import { material, placed } from './layers';
import type { Layers, SharedUniforms } from './layers';
import { dotFragment, dotVertex } from './mark_shaders';

interface DotLook {
  /** CSS pixels. */
  radius: number;
  rim: number;
  hole: number;
  tone: Vec3;
  rimTone: Vec3;
  opacity: number;
  isInFront: boolean;
}

const offWhite: Vec3 = [0.98, 0.98, 0.97];
const ink: Vec3 = [0.13, 0.15, 0.18];
const pinLook: DotLook = {
  radius: 3.4, rim: 1, hole: 0, tone: offWhite, rimTone: ink, opacity: 1, isInFront: false,
};
const brightPinLook: DotLook = { ...pinLook, radius: 5.6, rim: 1.3, isInFront: true };
const ringLook: DotLook = { ...pinLook, radius: 6.5, rim: 1, hole: 2.6, opacity: 0.85, isInFront: true };
const pullLook: DotLook = { ...pinLook, radius: 4.2, rim: 1.2, isInFront: true };

/** Dots that all look alike; as many as there are. */
class Dots {
  private readonly look: RawShaderMaterial;
  private readonly points: Points;
  private positions = new BufferAttribute(new Float32Array(3), 3);

  constructor(layers: Layers, private readonly shared: SharedUniforms, private readonly of: DotLook) {
    const uniforms = {
      radius: { value: 1 }, rim: { value: 1 }, hole: { value: 0 }, lift: { value: 0 }, opacity: { value: of.opacity },
      tone: { value: new Vector3(...of.tone) }, rimTone: { value: new Vector3(...of.rimTone) },
    };
    this.look = material({
      vertex: dotVertex, fragment: dotFragment, uniforms, isBlended: true, isInFront: of.isInFront,
    });
    this.points = placed(new Points(new BufferGeometry(), this.look));
    this.points.visible = false;
    layers.dots.add(this.points);
    this.makeRoom(64);
  }

  set(count: number, place: (i: number, to: ArrayLike<number> & { [index: number]: number }) => void): void {
    if (count > this.positions.count) this.makeRoom(2 * count);
    for (let i = 0; i < count; ++i) place(i, this.positions.array);
    this.positions.needsUpdate = true;
    this.points.geometry.setDrawRange(0, count);
    this.points.visible = count > 0;
  }

  setOne(at: Vec3 | null): void {
    this.set(at === null ? 0 : 1, (_, to) => {
      [to[0], to[1], to[2]] = at ?? [0, 0, 0];
    });
  }

  prepare(): void {
    const { uniforms } = this.look;
    const ratio = this.shared.pixelRatio.value;
    // So small a dot would vanish where pixels are large.
    uniforms['radius']!.value = Math.max(this.of.radius * ratio, 2.2);
    uniforms['rim']!.value = Math.max(this.of.rim * ratio, 0.7);
    uniforms['hole']!.value = this.of.hole * ratio;
    uniforms['lift']!.value = 4 * this.shared.lift.value;
  }

  dispose(): void {
    this.points.geometry.dispose();
    this.look.dispose();
  }

  private makeRoom(count: number): void {
    this.points.geometry.dispose();
    this.positions = new BufferAttribute(new Float32Array(3 * count), 3);
    this.positions.setUsage(DynamicDrawUsage);
    this.points.geometry = new BufferGeometry();
    this.points.geometry.setAttribute('position', this.positions);
  }
}

export class Marks {
  private readonly pins: Dots;
  private readonly brightPin: Dots;
  private readonly ring: Dots;
  private readonly pull: Dots;

  constructor(layers: Layers, shared: SharedUniforms) {
    this.pins = new Dots(layers, shared, pinLook);
    this.brightPin = new Dots(layers, shared, brightPinLook);
    this.ring = new Dots(layers, shared, ringLook);
    this.pull = new Dots(layers, shared, pullLook);
  }

  update(frame: Frame): void {
    this.pins.set(frame.pins.length, (i, to) => {
      const first = 3 * frame.pins[i]!;
      for (let k = 0; k < 3; ++k) to[3 * i + k] = frame.positions[first + k]!;
    });
    this.pull.setOne(frame.pull?.to ?? null);
  }

  /** Lights up a place, or none. */
  highlight(at: Vec3 | null, isPin: boolean): void {
    this.brightPin.setOne(isPin ? at : null);
    this.ring.setOne(isPin ? null : at);
  }

  clear(): void {
    for (const each of this.all) each.setOne(null);
  }

  prepare(): void {
    for (const each of this.all) each.prepare();
  }

  dispose(): void {
    for (const each of this.all) each.dispose();
  }

  private get all(): Dots[] {
    return [this.pins, this.brightPin, this.ring, this.pull];
  }
}
