// Shadows of bodies and colliders on each other: depths as the light sees them.
import {
  DepthTexture, LessEqualCompare, LinearFilter, Matrix4, RedFormat, UnsignedIntType, WebGLRenderTarget,
} from 'three';
import type { Camera, WebGLRenderer } from 'three';
import type { Vec3 } from '../protocol';
import type { Layers, SharedUniforms } from './layers';
import { cross, dot, times, unit } from './vectors';
import type { Box } from './vectors';

/** From space to where light that comes from there sees a ball: -1 to 1 in all directions. */
function seenByLight(center: Vec3, radius: number, light: Vec3): Matrix4 {
  const aside: Vec3 = Math.abs(light[2]) < 0.9 ? [0, 0, 1] : [0, 1, 0];
  const right = unit(cross(aside, light));
  const rows = [right, cross(light, right), times(-1, light)].map((row) => times(1 / radius, row));
  const numbers = rows.flatMap((row) => [...row, -dot(row, center)]);
  const [a, b, c, d, e, f, g, h, i, j, k, l] = numbers as [number, number, number, number, number, number, number,
    number, number, number, number, number];
  return new Matrix4().set(a, b, c, d, e, f, g, h, i, j, k, l, 0, 0, 0, 1);
}

const toTexture = new Matrix4().set(0.5, 0, 0, 0.5, 0, 0.5, 0, 0.5, 0, 0, 0.5, 0.5, 0, 0, 0, 1);

export class ShadowMap {
  private target: WebGLRenderTarget | null = null;

  constructor(private readonly shared: SharedUniforms) {}

  /** size: of the map in texels; 0: there is none. */
  draw(renderer: WebGLRenderer, layers: Layers, camera: Camera, size: number, bounds: Box, light: Vec3,
       setback: number): void {
    if (size === 0 || bounds.isEmpty) return;
    const target = this.makeTarget(size);
    const radius = Math.max(1.05 * bounds.radius, 1e-3);
    const matrix = seenByLight(bounds.center, radius, light);
    this.shared.lightMatrix.value.copy(matrix);
    this.shared.toShadowMap.value.copy(toTexture).multiply(matrix);
    this.shared.texel.value = (2 * radius) / size;
    this.shared.setbackInLight.value = setback / radius;
    this.shared.shadowMap.value = target.depthTexture;
    renderer.setRenderTarget(target);
    renderer.setClearColor(0, 0);
    renderer.render(layers.light, camera);
  }

  dispose(): void {
    this.target?.dispose();
    this.target?.depthTexture?.dispose();
    this.target = null;
    this.shared.shadowMap.value = null;
  }

  private makeTarget(size: number): WebGLRenderTarget {
    if (this.target?.width === size) return this.target;
    this.dispose();
    const depthTexture = new DepthTexture(size, size, UnsignedIntType);
    depthTexture.compareFunction = LessEqualCompare;
    depthTexture.minFilter = depthTexture.magFilter = LinearFilter;
    this.target = new WebGLRenderTarget(size, size, { format: RedFormat, generateMipmaps: false, depthTexture });
    return this.target;
  }
}
