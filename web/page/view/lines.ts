// Ropes, and the line along which something is pulled.
import {
  BufferAttribute, DynamicDrawUsage, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, Vector2,
} from 'three';
import type { RawShaderMaterial } from 'three';
import type { Frame, SceneLook } from '../protocol';
import { material, placed } from './layers';
import type { Layers, SharedUniforms, Uniforms } from './layers';
import { strokeDepthVertex, strokeFlattenVertex, strokeFragment, strokeVertex } from './mark_shaders';
import { depthFragment, flattenFragment } from './surface_shaders';

/** CSS pixels. */
const ropeWidth = 3.3, pullWidth = 3.2;
/** Texels of the maps. */
const shadowWidth = 1.5;
const pullTone = [40, 44, 52];

/** Strips between two points each, that can be moved. */
class Strips {
  readonly geometry = new InstancedBufferGeometry();
  private readonly from: InstancedBufferAttribute;
  private readonly to: InstancedBufferAttribute;

  constructor(readonly count: number, tones: Uint8Array) {
    const changing = (): InstancedBufferAttribute => {
      const attribute = new InstancedBufferAttribute(new Float32Array(3 * count), 3);
      attribute.setUsage(DynamicDrawUsage);
      return attribute;
    };
    this.from = changing();
    this.to = changing();
    this.geometry.setAttribute('corner', new BufferAttribute(new Float32Array([0, -1, 1, -1, 0, 1, 1, 1]), 2));
    this.geometry.setIndex([0, 1, 2, 2, 1, 3]);
    this.geometry.setAttribute('from', this.from);
    this.geometry.setAttribute('to', this.to);
    this.geometry.setAttribute('tone', new InstancedBufferAttribute(tones, 3, true));
    this.geometry.instanceCount = count;
  }

  set(i: number, from: ArrayLike<number>, a: number, to: ArrayLike<number>, b: number): void {
    for (let k = 0; k < 3; ++k) {
      this.from.array[3 * i + k] = from[3 * a + k]!;
      this.to.array[3 * i + k] = to[3 * b + k]!;
    }
  }

  changed(): void {
    this.from.needsUpdate = this.to.needsUpdate = true;
  }
}

export class Lines {
  private readonly widths = { rope: { value: 1 }, pull: { value: 1 } };
  private readonly materials: RawShaderMaterial[];
  private readonly pull = new Strips(1, new Uint8Array(pullTone));
  private readonly pullMesh: Mesh;
  private ropes = new Strips(0, new Uint8Array());
  private ends: Uint32Array = new Uint32Array();
  private meshes: Mesh[] = [];

  constructor(private readonly layers: Layers, private readonly shared: SharedUniforms) {
    const { picture, lift } = shared;
    const stroke = (width: { value: number }, isRound: boolean): RawShaderMaterial => material({
      vertex: strokeVertex, fragment: strokeFragment, isBlended: true, isInFront: !isRound,
      uniforms: { picture, lift, width, soft: { value: 0.75 }, isRound: { value: isRound } },
    });
    const shadow = (vertex: string, fragment: string, uniforms: Uniforms): RawShaderMaterial => material({
      vertex, fragment, isInFront: vertex === strokeFlattenVertex,
      uniforms: { ...uniforms, width: { value: shadowWidth }, soft: { value: 0 } },
    });
    // The maps of shadows differ in size; about as wide in all of them is enough.
    const inLight = shadow(strokeDepthVertex, depthFragment,
                           { lightMatrix: shared.lightMatrix, picture: { value: new Vector2(1024, 1024) } });
    inLight.colorWrite = false;
    const onFloor = shadow(strokeFlattenVertex, flattenFragment,
                           { ...shared.flattening, picture: { value: new Vector2(192, 192) } });
    this.materials = [stroke(this.widths.rope, true), inLight, onFloor, stroke(this.widths.pull, false)];
    this.pullMesh = placed(new Mesh(this.pull.geometry, this.materials[3]));
    this.pullMesh.visible = false;
    layers.dots.add(this.pullMesh);
  }

  show(look: SceneLook): void {
    const { layers, materials } = this;
    for (const mesh of this.meshes) mesh.removeFromParent();
    this.ropes.geometry.dispose();
    this.ends = look.ropes;
    const count = this.ends.length / 2;
    const tones = new Uint8Array(3 * count);
    for (let i = 0; i < count; ++i) {
      const first = 4 * this.ends[2 * i]!;
      tones.set(look.front.subarray(first, first + 3), 3 * i);
    }
    this.ropes = new Strips(count, tones);
    this.meshes = count === 0 ? [] : materials.slice(0, 3).map((each) => placed(new Mesh(this.ropes.geometry, each)));
    this.meshes.forEach((mesh, i) => [layers.lines, layers.light, layers.mask][i]?.add(mesh));
    this.pullMesh.visible = false;
  }

  update(frame: Frame): void {
    for (let i = 0; i < this.ropes.count; ++i) {
      this.ropes.set(i, frame.positions, this.ends[2 * i]!, frame.positions, this.ends[2 * i + 1]!);
    }
    this.ropes.changed();
    this.pullMesh.visible = frame.pull !== null;
    if (frame.pull === null) return;
    this.pull.set(0, frame.pull.from, 0, frame.pull.to, 0);
    this.pull.changed();
  }

  /** Before a picture: widths are in pixels of its drawing buffer. */
  prepare(): void {
    this.widths.rope.value = ropeWidth * this.shared.pixelRatio.value;
    this.widths.pull.value = pullWidth * this.shared.pixelRatio.value;
  }

  dispose(): void {
    this.ropes.geometry.dispose();
    this.pull.geometry.dispose();
    for (const each of this.materials) each.dispose();
  }
}
