// Colliders: solids with their shadows, and planes as floors.
import { BufferAttribute, BufferGeometry, Group, Matrix4, Mesh, Quaternion, Vector3 } from 'three';
import type { RawShaderMaterial } from 'three';
import type { ColliderLook, Frame, Vec3 } from '../protocol';
import { shadowMaterials } from './bodies';
import { define, material, placed } from './layers';
import type { Layers, SharedUniforms } from './layers';
import { solidFragment, solidVertex } from './surface_shaders';
import { Box } from './vectors';

export interface PlacedCollider {
  look: ColliderLook;
  /** From its frame to space. */
  place: Matrix4;
  /** Around it, in its frame. */
  box: Box;
  /** Whether the last frame had it. */
  isThere: boolean;
}

const one = new Vector3(1, 1, 1);

export class Colliders {
  readonly all: PlacedCollider[] = [];
  private readonly solid: RawShaderMaterial;
  private readonly shadows: [RawShaderMaterial, RawShaderMaterial];
  private readonly groups: [Group, Group, Group] = [new Group(), new Group(), new Group()];
  private geometries: BufferGeometry[] = [];

  constructor(layers: Layers, shared: SharedUniforms) {
    this.solid = material({
      vertex: solidVertex, fragment: solidFragment, uniforms: { ...shared.lighting, setback: shared.setback },
    });
    this.shadows = shadowMaterials(shared, shared.setbackInLight);
    layers.solids.add(this.groups[0]);
    layers.light.add(this.groups[1]);
    layers.mask.add(this.groups[2]);
  }

  get planes(): PlacedCollider[] {
    return this.all.filter((each) => each.look.isPlane && each.isThere);
  }

  get solids(): PlacedCollider[] {
    return this.all.filter((each) => !each.look.isPlane && each.isThere);
  }

  set hasShadows(on: boolean) {
    define(this.solid, 'SHADOWS', on);
  }

  show(looks: ColliderLook[]): void {
    for (const geometry of this.geometries) geometry.dispose();
    for (const group of this.groups) group.clear();
    this.geometries = [];
    this.all.length = 0;
    for (const look of looks) this.add(look);
  }

  /** Where they are now. One that the frame does not have is not drawn. */
  update(frame: Frame): void {
    for (const each of this.all) each.isThere = false;
    frame.colliders.forEach((number, i) => {
      const collider = this.all.find((each) => each.look.number === number);
      if (collider === undefined) return;
      const pose = frame.poses.subarray(7 * i, 7 * i + 7);
      collider.isThere = true;
      collider.place.compose(new Vector3().fromArray(pose), new Quaternion().fromArray(pose, 3), one);
    });
    const there = this.all.filter((each) => !each.look.isPlane).map((each) => each.isThere);
    for (const group of this.groups) group.children.forEach((child, i) => (child.visible = there[i] === true));
  }

  dispose(): void {
    this.show([]);
    for (const each of [this.solid, ...this.shadows]) each.dispose();
  }

  private add(look: ColliderLook): void {
    const place = new Matrix4();
    const box = new Box();
    box.addAll(look.positions);
    this.all.push({ look, place, box, isThere: false });
    if (look.isPlane) return;
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(look.positions, 3));
    geometry.setAttribute('normal', new BufferAttribute(look.normals, 3));
    this.geometries.push(geometry);
    [this.solid, ...this.shadows].forEach((each, i) => {
      const mesh = placed(new Mesh(geometry, each), place);
      mesh.visible = false;
      this.groups[i]?.add(mesh);
    });
  }
}

/** A point of a frame in space, or of space in a frame. */
export function moved(place: Matrix4, point: Vec3): Vec3 {
  const v = new Vector3(...point).applyMatrix4(place);
  return [v.x, v.y, v.z];
}
