// Bodies, solid colliders, and what both leave in the maps of shadows.
import { lighting, precision } from './lighting_shader';

/** The tone of all colliders (sRGB). */
const solidTone = 'pow(vec3(0.60, 0.65, 0.71), vec3(2.2))';

export const bodyVertex = `${precision}
in vec3 position, normal, place;
in vec4 front, back, second;
uniform mat4 viewMatrix, projectionMatrix;
out vec3 pointHere, normalHere, placeHere;
flat out vec4 frontHere, backHere, secondHere;  // in linear light
vec4 linear(vec4 tone) { return vec4(pow(tone.rgb, vec3(2.2)), tone.a); }
void main() {
  pointHere = position;
  normalHere = normal;
  placeHere = place;
  frontHere = linear(front);
  backHere = linear(back);
  secondHere = linear(second);
  gl_Position = projectionMatrix * (viewMatrix * vec4(position, 1));
}`;

/** The back of a sheet is lit as its front. */
export const bodyFragment = `${precision}${lighting}
in vec3 pointHere, normalHere, placeHere;
flat in vec4 frontHere, backHere, secondHere;
out vec4 color;

/// 1 and -1 in turn between whole numbers, and on the way where a pixel has both.
vec3 inTurn(vec3 at) {
  vec3 away = abs(mod(at + 0.5, 2.0) - 1.0) - 0.5;
  return clamp(away / max(fwidth(at), 1e-5), -0.5, 0.5) * 2.0;
}

vec3 ownTone() {
  int pattern = int(255.0 * backHere.a + 0.5);
  vec3 base = gl_FrontFacing ? frontHere.rgb : backHere.rgb;
  vec3 turns = inTurn(placeHere);
  if (pattern == 0) return base;
  float turn = pattern == 1 ? turns.x * turns.y * turns.z : turns.x;
  return mix(base, secondHere.rgb, 0.5 + 0.5 * turn);
}

void main() {
  vec3 n = normalize(normalHere + 1e-9 * (eye - pointHere));  // never of length zero
  if (!gl_FrontFacing) n = -n;
  color = vec4(lit(ownTone(), pointHere, n, frontHere.a > 0.5), 1);
}`;

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
