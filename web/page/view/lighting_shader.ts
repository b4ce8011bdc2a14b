// How light falls, as in the desktop window: see apps/render/shaders_light.cpp.

/** Put before every program. */
export const precision = `
precision highp float;
precision highp int;
precision highp sampler2DShadow;
`;

/**
 * Put before the fragment programs of surfaces. Light is added up in linear light, and rolls off where a tone would be
 * brighter than white. There is no map of how much of the sky a point sees; what looks down sees less of it.
 */
export const lighting = `
uniform vec3 eye, light;              // in space [m]; to the light, of length 1
#ifdef SHADOWS
uniform int taps;                     // places looked up in the map of shadows: 16 or 4
uniform sampler2DShadow shadowMap;    // depths as the light sees them
uniform mat4 toShadowMap;             // from space to its texture
uniform float texel;                  // of the map [m]
#endif

const vec3 keyLight = vec3(0.80, 0.755, 0.69), sky = vec3(0.37, 0.41, 0.46), ground = vec3(0.22, 0.205, 0.19);
const float fromEye = 0.12;
const float through = 0.3;  // of the light on the other side of cloth

/// Places in a disc of three texels; where the four outer ones agree, the others would too.
float keyShare(vec3 point, vec3 n, float towards) {
#ifdef SHADOWS
  vec3 from = point + n * (texel * (1.0 + 2.5 * sqrt(1.0 - min(towards * towards, 1.0))));
  vec3 at = (toShadowMap * vec4(from, 1)).xyz;
  if (any(greaterThan(abs(at - 0.5), vec3(0.5)))) return 1.0;
  vec2 unit = 3.0 / vec2(textureSize(shadowMap, 0));
  float sum = 0.0;
  for (int i = taps - 1; i >= 0; --i) {
    float reach = sqrt((float(i) + 0.5) / float(taps)), angle = 2.39996 * float(i);
    sum += texture(shadowMap, vec3(at.xy + unit * reach * vec2(cos(angle), sin(angle)), at.z));
    if (i == 12 && (sum < 0.001 || sum > 3.999)) return sum / 4.0;
  }
  return sum / float(taps);
#else
  return 1.0;
#endif
}

vec3 rollOff(vec3 c) {
  const float from = 0.75;
  if (max(max(c.r, c.g), c.b) <= from) return c;
  vec3 over = max(c - from, 0.0) / (1.0 - from);
  return min(c, from) + (1.0 - from) * (1.0 - exp(-over));
}

/// Linear light to the power of 1 / 2.2, within half of a step of 255; three times as fast where the processor draws.
vec3 tone(vec3 c) {
  vec3 root = sqrt(c);
  return 1.00816 * root + 0.069815 * sqrt(root) - 0.079872 * c;
}

/// The tone of a point whose own tone in linear light is base. Cloth has fibers that catch light at grazing angles
/// and let some through; what is solid has a soft highlight.
vec3 lit(vec3 base, vec3 point, vec3 n, bool isCloth) {
  vec3 toEye = normalize(eye - point);
  float towards = dot(n, light);
  float key = 0.0;
  if (towards > 0.0) key = towards * keyShare(point, n, towards);
  else if (isCloth) key = -through * towards * keyShare(point, -n, -towards);
  float open = 0.97 + 0.03 * n.z;
  float facing = clamp(dot(n, toEye), 0.0, 1.0);
  vec3 around = open * (mix(ground, sky, 0.5 + 0.5 * n.z) + fromEye * facing);
  vec3 color = base * ((0.6 + 0.4 * open) * key * keyLight + around);
  float rim = (1.0 - facing) * (1.0 - facing);
  rim *= rim;
  if (isCloth) {
    color += 0.30 * rim * mix(vec3(1), base, 0.6) * (0.6 * key * keyLight + around);
  } else {
    float glance = max(dot(n, normalize(light + toEye)), 0.0);
    color += 0.10 * key * pow(glance, 40.0) * keyLight + 0.10 * rim * open * sky;
  }
  return tone(rollOff(color));
}
`;
