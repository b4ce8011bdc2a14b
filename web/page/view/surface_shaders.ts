// Bodies, solid colliders, and what both leave in the maps of shadows.
import { lighting, precision } from './lighting_shader';

/** The tone of all colliders (sRGB). */
const solidTone = 'pow(vec3(0.60, 0.65, 0.71), vec3(2.2))';

export const bodyVertex = `${precision}
in vec3 position, normal;
in vec4 front, back;
uniform mat4 viewMatrix, projectionMatrix;
out vec3 pointHere, normalHere;
flat out vec4 frontHere, backHere;  // in linear light
#ifdef PATTERNS
in vec3 place;
in vec4 second;
out vec3 placeHere;
flat out vec4 secondHere;
#endif
#ifdef VALUES
in float value;
uniform vec2 range;
out float shareHere;  // of the way from the lowest value to the highest
#endif
vec4 linear(vec4 tone) { return vec4(pow(tone.rgb, vec3(2.2)), tone.a); }
void main() {
  pointHere = position;
  normalHere = normal;
  frontHere = linear(front);
  backHere = linear(back);
#ifdef PATTERNS
  placeHere = place;
  secondHere = linear(second);
#endif
#ifdef VALUES
  shareHere = (value - range.x) / (range.y - range.x);
#endif
  gl_Position = projectionMatrix * (viewMatrix * vec4(position, 1));
}`;

/** The back of a sheet is lit as its front. */
export const bodyFragment = `${precision}${lighting}
in vec3 pointHere, normalHere;
flat in vec4 frontHere, backHere;
out vec4 color;

#ifdef PATTERNS
in vec3 placeHere;
flat in vec4 secondHere;
/// 1 and -1 in turn between whole numbers, and on the way where a pixel has both.
vec3 inTurn(vec3 at) {
  vec3 away = abs(mod(at + 0.5, 2.0) - 1.0) - 0.5;
  return clamp(away / max(fwidth(at), 1e-5), -0.5, 0.5) * 2.0;
}

vec3 withPattern(vec3 base) {
  int pattern = int(255.0 * backHere.a + 0.5);
  vec3 turns = inTurn(placeHere);
  if (pattern == 0) return base;
  float turn = pattern == 1 ? turns.x * turns.y * turns.z : turns.x;
  return mix(base, secondHere.rgb, 0.5 + 0.5 * turn);
}
#endif
#ifdef VALUES
in float shareHere;
uniform sampler2D tones;
#endif

vec3 ownTone() {
  vec3 base = gl_FrontFacing ? frontHere.rgb : backHere.rgb;
#ifdef PATTERNS
  base = withPattern(base);
#endif
#ifdef VALUES
  float count = float(textureSize(tones, 0).x);
  float at = (0.5 + clamp(shareHere, 0.0, 1.0) * (count - 1.0)) / count;
  base = pow(textureLod(tones, vec2(at, 0.5), 0.0).rgb, vec3(2.2));
#endif
  return base;
}

void main() {
  vec3 n = normalize(normalHere + 1e-9 * (eye - pointHere));  // never of length zero
  if (!gl_FrontFacing) n = -n;
  color = vec4(lit(ownTone(), pointHere, n, frontHere.a > 0.5), 1);
}`;

/** Edges of triangles, towards the eye of what they lie on. */
export const edgeVertex = `${precision}
in vec3 position;
uniform mat4 viewMatrix, projectionMatrix;
uniform float lift;
void main() {
  gl_Position = projectionMatrix * (viewMatrix * vec4(position, 1));
  gl_Position.z -= lift * gl_Position.w;
}`;

export const edgeFragment = `${precision}
out vec4 color;
void main() { color = vec4(0.10, 0.11, 0.14, 0.55); }`;

/** setback [m]: colliders give way to what touches them. */
export const solidVertex = `${precision}
in vec3 position, normal;
uniform mat4 modelMatrix, viewMatrix, projectionMatrix;
uniform float setback;
out vec3 pointHere, normalHere;
void main() {
  pointHere = (modelMatrix * vec4(position, 1)).xyz;
  normalHere = mat3(modelMatrix) * normal;
  gl_Position = projectionMatrix * (viewMatrix * vec4(pointHere, 1));
  gl_Position.z += setback * gl_Position.w;
}`;

export const solidFragment = `${precision}${lighting}
in vec3 pointHere, normalHere;
out vec4 color;
void main() {
  vec3 n = normalize(normalHere + 1e-9 * (eye - pointHere));
  color = vec4(lit(${solidTone}, pointHere, gl_FrontFacing ? n : -n, false), 1);
}`;

/** As the light sees it. */
export const depthVertex = `${precision}
in vec3 position;
uniform mat4 modelMatrix, lightMatrix;
uniform float setback;
void main() {
  gl_Position = lightMatrix * (modelMatrix * vec4(position, 1));
  gl_Position.z += setback;
}`;

export const depthFragment = `${precision}
void main() {}`;

/** Along the light onto a floor; what is below it stays where it is. */
export const flatten = `
uniform mat4 toFloor;    // to the frame of the floor, where the light is given too
uniform vec3 floorLight;
uniform vec2 middle, reach;
vec4 flattened(vec4 point) {
  vec3 p = (toFloor * point).xyz;
  p -= floorLight * (max(p.z, 0.0) / floorLight.z);
  return vec4((p.xy - middle) / reach, 0, 1);
}
`;

export const flattenVertex = `${precision}${flatten}
in vec3 position;
uniform mat4 modelMatrix;
void main() { gl_Position = flattened(modelMatrix * vec4(position, 1)); }`;

export const flattenFragment = `${precision}
out vec4 color;
void main() { color = vec4(1); }`;
