// Floors that fade into the background, each with the shadow that lies on it.
import { BufferAttribute, BufferGeometry, CustomBlending, Matrix4, Mesh, NoBlending, Vector2, Vector3 } from 'three';
import type { IUniform, RawShaderMaterial, WebGLRenderer } from 'three';
import type { Vec3 } from '../protocol';
import { moved } from './colliders';
import type { PlacedCollider } from './colliders';
import { FloorShadow } from './floor_shadow';
import type { Blur } from './floor_shadow';
import { material, placed } from './layers';
import type { Layers, SharedUniforms } from './layers';
import { floorFragment, floorVertex } from './mark_shaders';
import { Box, dot, subtract } from './vectors';

const sectors = 24;
/** Over a floor, for a shadow on it. */
const leastSlopeOfLight = 0.05;

export interface FloorTones {
  background: Vec3;
  /** Of a floor that looks up (sRGB). */
  tone: Vec3;
  shadow: number;
}

/** A disc about the middle; what fades on it is reckoned for each pixel. */
function disc(): BufferGeometry {
  const places: number[] = [0, 0, 0];
  const corners: number[] = [];
  for (let sector = 0; sector < sectors; ++sector) {
    const angle = (2 * Math.PI * sector) / sectors;
    places.push(Math.cos(angle), Math.sin(angle), 0);
    corners.push(0, sector + 1, ((sector + 1) % sectors) + 1);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(places), 3));
  geometry.setIndex(corners);
  return geometry;
}

/** Of a face with this normal, without the light from the eye. */
function lightOn(normal: Vec3, light: Vec3): number {
  return 0.31 + 0.1 * normal[2] + 0.75 * Math.max(dot(normal, light), 0);
}

class Floor {
  readonly mesh: Mesh;
  private readonly look: RawShaderMaterial;
  private readonly place = new Matrix4();
  private readonly shadow: FloorShadow;

  constructor(private readonly shared: SharedUniforms, geometry: BufferGeometry) {
    this.shadow = new FloorShadow(shared);
    const uniforms = {
      place: { value: this.place }, center: { value: new Vector2() }, extent: { value: 1 }, setback: shared.setback,
      tone: { value: new Vector3() }, background: { value: new Vector3() }, isFirst: { value: false },
      middle: { value: this.shadow.middle }, reach: { value: this.shadow.reach }, darkness: { value: 0 },
      mask: { value: this.shadow.mask },
    };
    this.look = material({ vertex: floorVertex, fragment: floorFragment, uniforms, isBlended: true });
    this.mesh = placed(new Mesh(geometry, this.look));
  }

  get normal(): Vec3 {
    const e = this.place.elements;
    return [e[8], e[9], e[10]];
  }

  get origin(): Vec3 {
    const e = this.place.elements;
    return [e[12], e[13], e[14]];
  }

  /** isGround: not a collider, so that it hides nothing. */
  put(place: Matrix4, bounds: Box, light: Vec3, tones: FloorTones, isGround: boolean): void {
    this.place.copy(place);
    const center = moved(place.clone().invert(), bounds.center);
    const share = (lightOn(this.normal, light) / lightOn([0, 0, 1], light)) ** 0.4545;
    this.uniform('center').value.set(center[0], center[1]);
    this.uniform('extent').value = Math.max(12 * bounds.radius, 1);
    this.uniform('tone').value.set(...tones.tone.map((x) => Math.min(x * share, 1)) as Vec3);
    this.uniform('darkness').value = dot(this.normal, light) > leastSlopeOfLight && !bounds.isEmpty ? tones.shadow : 0;
    this.uniform('background').value.set(...tones.background);
    this.look.depthTest = this.look.depthWrite = !isGround;
  }

  /** isFirst: of all that are seen. */
  prepare(isFirst: boolean): void {
    this.uniform('isFirst').value = isFirst;
    this.look.blending = isFirst ? NoBlending : CustomBlending;
  }

  drawShadow(renderer: WebGLRenderer, layers: Layers, blur: Blur, size: number, positions: Float32Array,
             solids: PlacedCollider[]): void {
    if (this.uniform('darkness').value === 0) return;
    this.shadow.draw(renderer, layers, blur, size, this.place, this.shared.light.value, positions, solids);
  }

  dispose(): void {
    this.shadow.dispose();
    this.look.dispose();
  }

  private uniform(name: string): IUniform {
    return this.look.uniforms[name]!;
  }
}

export class Floors {
  private readonly geometry = disc();
  private readonly all: Floor[] = [];
  private count = 0;

  constructor(private readonly layers: Layers, private readonly shared: SharedUniforms) {}

  /** Planes that are colliders, or else the ground at a height, where there is one. */
  update(planes: PlacedCollider[], ground: number | null, bounds: Box, light: Vec3, tones: FloorTones): void {
    const places = planes.map((each) => each.place).sort((a, b) => b.elements[10] - a.elements[10]);
    const isGround = places.length === 0 && ground !== null;
    if (isGround) places.push(new Matrix4().makeTranslation(0, 0, ground));
    this.count = places.length;
    places.forEach((place, i) => this.floor(i).put(place, bounds, light, tones, isGround));
  }

  /** size: of each mask in texels. */
  drawShadows(renderer: WebGLRenderer, blur: Blur, size: number, positions: Float32Array,
              solids: PlacedCollider[]): void {
    for (const floor of this.all.slice(0, this.count)) {
      floor.drawShadow(renderer, this.layers, blur, size, positions, solids);
    }
  }

  /** Before a picture: floors are seen from above only. */
  prepare(eye: Vec3): void {
    let isFirst = true;
    this.all.forEach((floor, i) => {
      floor.mesh.visible = i < this.count && dot(floor.normal, subtract(eye, floor.origin)) > 0;
      floor.prepare(isFirst);
      if (floor.mesh.visible) isFirst = false;
    });
  }

  dispose(): void {
    for (const floor of this.all) floor.dispose();
    this.geometry.dispose();
  }

  private floor(i: number): Floor {
    const known = this.all[i];
    if (known !== undefined) return known;
    const made = new Floor(this.shared, this.geometry);
    this.all.push(made);
    this.layers.floors.add(made.mesh);
    return made;
  }
}
