// Lines, dots, floors and the blur of their shadows.
import { precision } from './lighting_shader';
import { flatten } from './surface_shaders';

/** Two points in the picture become a strip that is `width` pixels wide. */
const strip = `
in vec2 corner;          // which end, and -1 or 1 for the side
in vec3 from, to;
uniform vec2 picture;    // pixels
uniform float width, soft;
out float across;
out vec2 sideways;
vec4 stripAt(vec4 a, vec4 b) {
  const float least = 1e-4;
  if (a.w < least) a = mix(a, b, clamp((least - a.w) / max(b.w - a.w, 1e-9), 0.0, 1.0));
  if (b.w < least) b = mix(b, a, clamp((least - b.w) / max(a.w - b.w, 1e-9), 0.0, 1.0));
  vec2 along = (b.xy / b.w - a.xy / a.w) * picture;
  float size = length(along);
  along = size > 1e-6 ? along / size : vec2(1, 0);
  sideways = vec2(-along.y, along.x);
  float reach = width / 2.0 + soft;
  across = corner.y * reach;
  vec4 p = corner.x < 0.5 ? a : b;
  return p + vec4(corner.y * sideways * 2.0 * reach / picture * p.w, 0, 0);
}
`;

export const strokeVertex = `${precision}${strip}
in vec3 tone;
uniform mat4 viewMatrix, projectionMatrix;
uniform float lift;      // towards the eye, so that it lies on what it touches
flat out vec3 toneHere;
void main() {
  toneHere = tone;
  mat4 camera = projectionMatrix * viewMatrix;
  gl_Position = stripAt(camera * vec4(from, 1), camera * vec4(to, 1));
  gl_Position.z -= lift * gl_Position.w;
}`;

/** A tube that faces the eye, or a thin line with light at both sides. */
export const strokeFragment = `${precision}
in float across;
in vec2 sideways;
flat in vec3 toneHere;
uniform float width;
uniform bool isRound;
out vec4 color;
void main() {
  float edge = clamp(width / 2.0 + 0.5 - abs(across), 0.0, 1.0);
  if (edge < 0.01) discard;
  vec3 base = toneHere;
  if (isRound) {
    float t = clamp(across / (width / 2.0), -1.0, 1.0);
    vec3 n = vec3(sideways * t, sqrt(max(0.0, 1.0 - t * t)));
    base *= 0.62 + 0.40 * max(dot(n, normalize(vec3(-0.3, 0.7, 0.7))), 0.0);
  } else {
    float core = clamp(width / 4.0 + 0.5 - abs(across), 0.0, 1.0);
    base = mix(vec3(1), base, core);
    edge *= mix(0.6, 1.0, core);
  }
  color = vec4(base, edge);
}`;

export const strokeDepthVertex = `${precision}${strip}
uniform mat4 lightMatrix;
void main() { gl_Position = stripAt(lightMatrix * vec4(from, 1), lightMatrix * vec4(to, 1)); }`;

export const strokeFlattenVertex = `${precision}${flatten}${strip}
void main() { gl_Position = stripAt(flattened(vec4(from, 1)), flattened(vec4(to, 1))); }`;

/** A dot with a dark rim, or a ring; radius and rim in pixels. */
export const dotVertex = `${precision}
in vec3 position;
uniform mat4 viewMatrix, projectionMatrix;
uniform float radius, lift;
void main() {
  gl_Position = projectionMatrix * (viewMatrix * vec4(position, 1));
  gl_Position.z -= lift * gl_Position.w;
  gl_PointSize = 2.0 * (radius + 1.0);
}`;

export const dotFragment = `${precision}
uniform float radius, rim, hole;
uniform vec3 tone, rimTone;
uniform float opacity;
out vec4 color;
void main() {
  float far = length(gl_PointCoord - 0.5) * 2.0 * (radius + 1.0);
  float inside = clamp(radius + 0.5 - far, 0.0, 1.0);
  float core = clamp(radius - rim + 0.5 - far, 0.0, 1.0);
  if (hole > 0.0) {
    inside *= clamp(far - hole + 0.5, 0.0, 1.0);
    core *= clamp(far - hole - rim + 0.5, 0.0, 1.0);
  }
  if (inside * opacity < 0.01) discard;
  color = vec4(mix(rimTone, tone, core), inside * opacity);
}`;

/** A floor about the middle of the scene; the third number of a place is how far out it is, from 0 to 1. */
export const floorVertex = `${precision}
in vec3 position;
uniform mat4 place, viewMatrix, projectionMatrix;
uniform vec2 center;
uniform float extent, setback;
out vec2 onFloor, onDisc;
void main() {
  onDisc = position.xy;
  onFloor = center + extent * position.xy;
  gl_Position = projectionMatrix * (viewMatrix * (place * vec4(onFloor, 0, 1)));
  gl_Position.z += setback * gl_Position.w;
}`;

export const floorFragment = `${precision}
in vec2 onFloor, onDisc;
uniform vec3 tone, background;
uniform vec2 middle, reach;
uniform float darkness;
uniform bool isFirst;  // it has nothing but the background behind it
uniform sampler2D mask;
out vec4 color;
void main() {
  float opacity = 1.0 - smoothstep(0.12, 1.0, length(onDisc));
  vec2 at = (onFloor - middle) / reach;
  float shadow = 0.0;
  if (darkness > 0.0 && max(abs(at.x), abs(at.y)) < 1.0) shadow = darkness * textureLod(mask, 0.5 * at + 0.5, 0.0).r;
  // Half a step of the screen's tones, so that the fading shows no bands.
  float grain = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
  vec3 here = (1.0 - shadow) * tone;
  color = isFirst ? vec4(mix(background, here, opacity), 1) : vec4(here, opacity);
  color.rgb += grain / 255.0;
}`;

export const screenVertex = `${precision}
in vec3 position;
out vec2 at;
void main() {
  at = 0.5 * position.xy + 0.5;
  gl_Position = vec4(position.xy, 0, 1);
}`;

export const blurFragment = `${precision}
in vec2 at;
uniform sampler2D mask;
uniform vec2 stepSize;
out vec4 color;
void main() {
  // Seven of a bell's values, in pairs: a place between two texels has both.
  float sum = 0.1585 * textureLod(mask, at, 0.0).r;
  vec3 weights = vec3(0.2623, 0.1234, 0.0351), places = vec3(1.4415, 3.3661, 5.3638);
  for (int i = 0; i < 3; ++i) {
    vec2 aside = places[i] * stepSize;
    sum += weights[i] * (textureLod(mask, at + aside, 0.0).r + textureLod(mask, at - aside, 0.0).r);
  }
  color = vec4(sum, 0, 0, 1);
}`;
