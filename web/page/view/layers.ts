// The scenes of three.js that make up a picture, and the values that their programs share.
import {
  CustomBlending, DoubleSide, GLSL3, Group, Matrix4, NoBlending, OneFactor, OneMinusSrcAlphaFactor, RawShaderMaterial,
  Scene, SrcAlphaFactor, Vector2, Vector3, ZeroFactor,
} from 'three';
import type { IUniform, LineSegments, Mesh, Object3D, Points, Texture } from 'three';

export type Uniforms = Record<string, IUniform>;

/** What programs take that is the same for everything in a picture. */
export class SharedUniforms {
  readonly eye = { value: new Vector3() };
  readonly light = { value: new Vector3(0, 0, 1) };
  readonly taps = { value: 0 };
  readonly shadowMap: IUniform<Texture | null> = { value: null };
  readonly toShadowMap = { value: new Matrix4() };
  readonly texel = { value: 0 };
  readonly lightMatrix = { value: new Matrix4() };
  /** In the depths of OpenGL: of colliders, and of the same in the map of shadows. */
  readonly setback = { value: 0 };
  readonly setbackInLight = { value: 0 };
  /** Of the picture, in pixels of the drawing buffer. */
  readonly picture = { value: new Vector2(1, 1) };
  readonly pixelRatio = { value: 1 };
  readonly lift = { value: 0 };
  /** Of the floor whose shadow is drawn. */
  readonly toFloor = { value: new Matrix4() };
  readonly floorLight = { value: new Vector3(0, 0, 1) };
  readonly middle = { value: new Vector2() };
  readonly reach = { value: new Vector2(1, 1) };

  get lighting(): Uniforms {
    const { eye, light, taps, shadowMap, toShadowMap, texel } = this;
    return { eye, light, taps, shadowMap, toShadowMap, texel };
  }

  get flattening(): Uniforms {
    const { toFloor, floorLight, middle, reach } = this;
    return { toFloor, floorLight, middle, reach };
  }
}

export interface MaterialOptions {
  vertex: string;
  fragment: string;
  uniforms: Uniforms;
  /** Mixed with what is behind by its opacity. */
  isBlended?: boolean;
  isInFront?: boolean;
  writesDepth?: boolean;
}

/** Of a program that says everything itself. Blended ones are drawn in their place too, not after all others. */
export function material(options: MaterialOptions): RawShaderMaterial {
  return new RawShaderMaterial({
    glslVersion: GLSL3,
    vertexShader: options.vertex,
    fragmentShader: options.fragment,
    uniforms: options.uniforms,
    side: DoubleSide,
    blending: options.isBlended === true ? CustomBlending : NoBlending,
    blendSrc: SrcAlphaFactor,
    blendDst: OneMinusSrcAlphaFactor,
    // The picture stays opaque: the page would shine through.
    blendSrcAlpha: ZeroFactor,
    blendDstAlpha: OneFactor,
    depthTest: options.isInFront !== true,
    depthWrite: options.writesDepth ?? options.isInFront !== true,
  });
}

/** Whether a part of the programs is there: they are shorter without, and quicker to compile. */
export function define(look: RawShaderMaterial, part: 'SHADOWS' | 'PATTERNS' | 'VALUES', on: boolean): void {
  if ((look.defines[part] !== undefined) === on) return;
  if (on) look.defines[part] = '1';
  else delete look.defines[part];
  look.needsUpdate = true;
}

/** Put where `place` says, which may change; three.js neither moves it nor leaves it out. */
export function placed<T extends LineSegments | Mesh | Points>(made: T, place = new Matrix4()): T {
  made.frustumCulled = false;
  made.matrixAutoUpdate = false;
  made.matrixWorldAutoUpdate = false;
  made.matrixWorld = place;
  return made;
}

function still<T extends Object3D>(object: T): T {
  object.matrixAutoUpdate = object.matrixWorldAutoUpdate = false;
  return object;
}

/** What is drawn into the picture, in this order, and into the maps of shadows. */
export class Layers {
  readonly picture = still(new Scene());
  readonly light = still(new Scene());
  readonly mask = still(new Scene());
  readonly floors = still(new Group());
  readonly solids = still(new Group());
  readonly bodies = still(new Group());
  readonly lines = still(new Group());
  readonly dots = still(new Group());

  constructor() {
    this.picture.add(this.floors, this.solids, this.bodies, this.lines, this.dots);
  }
}
