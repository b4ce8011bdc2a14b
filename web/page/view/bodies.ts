// The triangles of all bodies.
import {
  BufferAttribute, BufferGeometry, DataTexture, DynamicDrawUsage, LinearFilter, LineSegments, Mesh, Vector2,
} from 'three';
import type { RawShaderMaterial } from 'three';
import type { ColorMap, Frame, SceneLook } from '../protocol';
import { define, material, placed } from './layers';
import type { Layers, SharedUniforms } from './layers';
import {
  bodyFragment, bodyVertex, depthFragment, depthVertex, edgeFragment, edgeVertex, flattenFragment, flattenVertex,
} from './surface_shaders';

function changing(count: number, size = 3): BufferAttribute {
  const attribute = new BufferAttribute(new Float32Array(size * count), size);
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
  private values = changing(0, 1);
  private edges: BufferGeometry | null = null;
  private edgeEnds: Uint32Array = new Uint32Array();
  private readonly edgeLook: RawShaderMaterial;
  /** What colors show. */
  private readonly tones = { value: new DataTexture(new Uint8Array(4), 1, 1) };
  private readonly range = { value: new Vector2(0, 1) };
  private showsEdges = false;

  constructor(private readonly layers: Layers, shared: SharedUniforms) {
    const { tones, range } = this;
    tones.value.needsUpdate = true;
    this.look = material({
      vertex: bodyVertex, fragment: bodyFragment, uniforms: { ...shared.lighting, tones, range },
    });
    this.edgeLook = material({
      vertex: edgeVertex, fragment: edgeFragment, uniforms: { lift: shared.lift }, isBlended: true, writesDepth: false,
    });
    this.shadows = shadowMaterials(shared, { value: 0 });
    this.place();
  }

  /** Makes room for other bodies. */
  show(look: SceneLook): void {
    // Both at once: with one of them the card forgets the positions, which the other has as well.
    this.geometry.dispose();
    this.edges?.dispose();
    this.edges = null;
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
    this.values = changing(count, 1);
    this.geometry.setAttribute('value', this.values);
    this.edgeEnds = look.edges;
    define(this.look, 'VALUES', false);
    define(this.look, 'PATTERNS', look.back.some((byte, i) => i % 4 === 3 && byte !== 0));
    this.place();
  }

  update(frame: Frame): void {
    this.positions.array.set(frame.positions);
    this.normals.array.set(frame.normals);
    this.positions.needsUpdate = this.normals.needsUpdate = true;
    const { values } = frame;
    define(this.look, 'VALUES', values !== null);
    if (values === null) return;
    this.values.array.set(values.numbers);
    this.values.needsUpdate = true;
    this.range.value.set(values.low, values.high);
  }

  setColors(map: ColorMap): void {
    const count = map.tones.length / 3;
    const texels = new Uint8Array(4 * count);
    for (let i = 0; i < count; ++i) texels.set(map.tones.subarray(3 * i, 3 * i + 3), 4 * i);
    this.tones.value.dispose();
    this.tones.value = new DataTexture(texels, count, 1);
    this.tones.value.minFilter = this.tones.value.magFilter = LinearFilter;
    this.tones.value.needsUpdate = true;
  }

  set hasShadows(on: boolean) {
    define(this.look, 'SHADOWS', on);
  }

  setWireframe(on: boolean): void {
    this.showsEdges = on;
    this.place();
  }

  dispose(): void {
    this.geometry.dispose();
    this.edges?.dispose();
    this.tones.value.dispose();
    for (const each of [this.look, this.edgeLook, ...this.shadows]) each.dispose();
  }

  /** They share the corners of the triangles. */
  private makeEdges(): BufferGeometry {
    if (this.edges !== null) return this.edges;
    this.edges = new BufferGeometry();
    this.edges.setIndex(new BufferAttribute(this.edgeEnds, 1));
    this.edges.setAttribute('position', this.positions);
    return this.edges;
  }

  private place(): void {
    const { layers, geometry } = this;
    layers.bodies.clear();
    for (const scene of [layers.light, layers.mask]) {
      scene.remove(...scene.children.filter((each) => each.name === 'body'));
    }
    if ((geometry.index?.count ?? 0) === 0) return;
    layers.bodies.add(placed(new Mesh(geometry, this.look)));
    if (this.showsEdges) layers.bodies.add(placed(new LineSegments(this.makeEdges(), this.edgeLook)));
    for (const [scene, look] of [[layers.light, this.shadows[0]], [layers.mask, this.shadows[1]]] as const) {
      const mesh = placed(new Mesh(geometry, look));
      mesh.name = 'body';
      scene.add(mesh);
    }
  }
}
