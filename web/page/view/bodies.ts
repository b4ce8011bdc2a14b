// The triangles of all bodies.
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh } from 'three';
import type { RawShaderMaterial } from 'three';
import type { Frame, SceneLook } from '../protocol';
import { material, placed } from './layers';
import type { Layers, SharedUniforms } from './layers';
import {
  bodyFragment, bodyVertex, depthFragment, depthVertex, flattenFragment, flattenVertex,
} from './surface_shaders';

function changing(count: number): BufferAttribute {
  const attribute = new BufferAttribute(new Float32Array(3 * count), 3);
  attribute.setUsage(DynamicDrawUsage);
  return attribute;
}

/** The programs of shadows, for bodies and colliders. */
export function shadowMaterials(shared: SharedUniforms,
                                setback: { value: number }): [RawShaderMaterial, RawShaderMaterial] {
  const inLight = material({
    vertex: depthVertex, fragment: depthFragment, uniforms: { lightMatrix: shared.lightMatrix, setback },
  });
  inLight.colorWrite = false;
  inLight.polygonOffset = true;
  inLight.polygonOffsetFactor = inLight.polygonOffsetUnits = 2;
  const onFloor = material({
    vertex: flattenVertex, fragment: flattenFragment, uniforms: shared.flattening, isInFront: true,
  });
  return [inLight, onFloor];
}

export class Bodies {
  private readonly look: RawShaderMaterial;
  private readonly shadows: [RawShaderMaterial, RawShaderMaterial];
  private geometry = new BufferGeometry();
  private positions = changing(0);
  private normals = changing(0);

  constructor(private readonly layers: Layers, shared: SharedUniforms) {
    this.look = material({ vertex: bodyVertex, fragment: bodyFragment, uniforms: shared.lighting });
    this.shadows = shadowMaterials(shared, { value: 0 });
    this.place();
  }

  /** Makes room for other bodies. */
  show(look: SceneLook): void {
    this.geometry.dispose();
    const count = look.vertexCount + look.copies.length;
    this.positions = changing(count);
    this.normals = changing(count);
    this.geometry = new BufferGeometry();
    this.geometry.setIndex(new BufferAttribute(look.triangles, 1));
    this.geometry.setAttribute('position', this.positions);
    this.geometry.setAttribute('normal', this.normals);
    this.geometry.setAttribute('front', new BufferAttribute(look.front, 4, true));
    this.geometry.setAttribute('back', new BufferAttribute(look.back, 4, true));
    this.geometry.setAttribute('second', new BufferAttribute(look.second, 4, true));
    this.geometry.setAttribute('place', new BufferAttribute(look.places, 3));
    this.place();
  }

  update(frame: Frame): void {
    this.positions.array.set(frame.positions);
    this.normals.array.set(frame.normals);
    this.positions.needsUpdate = this.normals.needsUpdate = true;
  }

  dispose(): void {
    this.geometry.dispose();
    for (const each of [this.look, ...this.shadows]) each.dispose();
  }

  private place(): void {
    const { layers, geometry } = this;
    layers.bodies.clear();
    for (const scene of [layers.light, layers.mask]) {
      scene.remove(...scene.children.filter((each) => each.name === 'body'));
    }
    if ((geometry.index?.count ?? 0) === 0) return;
    layers.bodies.add(placed(new Mesh(geometry, this.look)));
    for (const [scene, look] of [[layers.light, this.shadows[0]], [layers.mask, this.shadows[1]]] as const) {
      const mesh = placed(new Mesh(geometry, look));
      mesh.name = 'body';
      scene.add(mesh);
    }
  }
}
