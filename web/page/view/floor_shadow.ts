// The soft shadow on a floor: everything flattened onto it along the light, and blurred.
import {
  BufferAttribute, BufferGeometry, LinearFilter, Matrix4, Mesh, RedFormat, Scene, Vector2, Vector3, WebGLRenderTarget,
} from 'three';
import type { Camera, RawShaderMaterial, Texture, WebGLRenderer } from 'three';
import type { PlacedCollider } from './colliders';
import { material, placed } from './layers';
import type { Layers, SharedUniforms } from './layers';
import { blurFragment, screenVertex } from './mark_shaders';

const firstSize = 192;

function mask(): WebGLRenderTarget {
  return new WebGLRenderTarget(firstSize, firstSize, {
    format: RedFormat, minFilter: LinearFilter, magFilter: LinearFilter, depthBuffer: false, generateMipmaps: false,
  });
}

/** Blurs one mask in two steps, by way of another. */
export class Blur {
  private readonly half = mask();
  private readonly scene = new Scene();
  private readonly geometry = new BufferGeometry();
  private readonly look: RawShaderMaterial;

  constructor(readonly camera: Camera) {
    this.look = material({
      vertex: screenVertex, fragment: blurFragment, isInFront: true,
      uniforms: { mask: { value: null }, stepSize: { value: new Vector2() } },
    });
    this.geometry.setAttribute('position', new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
    this.scene.add(placed(new Mesh(this.geometry, this.look)));
  }

  /** Texels of the mask that it moves by, across and up. */
  apply(renderer: WebGLRenderer, target: WebGLRenderTarget, across: number, up: number): void {
    this.half.setSize(target.width, target.height);
    this.pass(renderer, target.texture, this.half, across, 0);
    this.pass(renderer, this.half.texture, target, 0, up);
  }

  dispose(): void {
    this.half.dispose();
    this.geometry.dispose();
    this.look.dispose();
  }

  private pass(renderer: WebGLRenderer, from: Texture, to: WebGLRenderTarget, across: number, up: number): void {
    this.look.uniforms['mask']!.value = from;
    this.look.uniforms['stepSize']!.value.set(across, up);
    renderer.setRenderTarget(to);
    renderer.render(this.scene, this.camera);
  }
}

export class FloorShadow {
  readonly middle = new Vector2();
  readonly reach = new Vector2(1, 1);
  private readonly target = mask();
  private readonly light = new Vector3();
  private readonly toFloor = new Matrix4();
  private readonly low = new Vector2();
  private readonly high = new Vector2();

  constructor(private readonly shared: SharedUniforms) {}

  get mask(): Texture {
    return this.target.texture;
  }

  /** size: of the mask in texels. */
  draw(renderer: WebGLRenderer, layers: Layers, blur: Blur, size: number, place: Matrix4, light: Vector3,
       positions: Float32Array, solids: PlacedCollider[]): void {
    this.toFloor.copy(place).invert();
    this.light.copy(light).transformDirection(this.toFloor);
    this.findArea(positions, solids);
    const { toFloor, floorLight, middle, reach } = this.shared;
    toFloor.value.copy(this.toFloor);
    floorLight.value.copy(this.light);
    middle.value.copy(this.middle);
    reach.value.copy(this.reach);
    this.target.setSize(size, size);
    renderer.setRenderTarget(this.target);
    renderer.setClearColor(0, 0);
    renderer.render(layers.mask, blur.camera);
    // As wide in both directions on the floor, not in the mask.
    const texel = (0.75 * Math.max(this.reach.x, this.reach.y)) / size;
    blur.apply(renderer, this.target, texel / this.reach.x, texel / this.reach.y);
  }

  dispose(): void {
    this.target.dispose();
  }

  /** Where the shadow is, and some more, since the blur reaches out. */
  private findArea(positions: Float32Array, solids: PlacedCollider[]): void {
    this.low.setScalar(Infinity);
    this.high.setScalar(-Infinity);
    this.addAll(positions, this.toFloor);
    for (const { box, place } of solids) {
      this.addAll(new Float32Array(box.corners().flat()), this.toFloor.clone().multiply(place));
    }
    this.middle.addVectors(this.low, this.high).multiplyScalar(0.5);
    this.reach.subVectors(this.high, this.low).multiplyScalar(0.5);
    this.reach.addScalar(0.08 * Math.max(this.reach.x, this.reach.y, 1e-3));
  }

  private addAll(points: Float32Array, frame: Matrix4): void {
    const m = frame.elements;
    const { low, high, light } = this;
    for (let i = 0; i + 2 < points.length; i += 3) {
      const x = points[i]!, y = points[i + 1]!, z = points[i + 2]!;
      const down = Math.max(m[2] * x + m[6] * y + m[10] * z + m[14], 0) / light.z;
      const u = m[0] * x + m[4] * y + m[8] * z + m[12] - light.x * down;
      const v = m[1] * x + m[5] * y + m[9] * z + m[13] - light.y * down;
      if (u < low.x) low.x = u;
      if (u > high.x) high.x = u;
      if (v < low.y) low.y = v;
      if (v > high.y) high.y = v;
    }
  }
}
