// How light falls: shadows of bodies on bodies, and how much of the sky a point sees.
#include "render/shaders.h"

namespace pliant_render::shaders {

// Colors are rounded to bytes; before that they are moved by less than half a step up or down, in a pattern of 4 by 4
// pixels of the picture, so that slow gradients have no bands. What is a byte to begin with stays as it is.
const std::string_view dithering = R"(
uniform float of_picture;  // pixels of the picture for one drawn, along a side

// Of 2 by 2 pixels: 0, 1/2 and 3/4, 1/4.
float order(vec2 at) {
  at = floor(at);
  return fract(0.5 * at.x + 0.75 * at.y * at.y);
}
vec3 dithered(vec3 color) {
  vec2 at = of_picture * gl_FragCoord.xy;
  at -= 4.0 * floor(0.25 * at);  // so that squares stay exact
  return color + (16.0 * order(at) + 4.0 * order(0.5 * at) - 7.5) * (0.05 / 255.0);
}
)";

// Put before the fragment programs of surfaces, behind the constants of SurfaceTraits. Light is added up in linear
// light, and rolls off where a tone would be brighter than white; a tone in full light comes out about as it was given.
const std::string_view lighting = R"(
uniform vec3 eye, light;              // in space [m]; to the light, of length 1
uniform sampler2D screen_light;       // of the picture: share of the sky, depth [m], share of the key light
uniform vec2 screen_scale;            // pixels of that for a pixel drawn

const vec3 key_light = vec3(0.80, 0.755, 0.69), sky = vec3(0.37, 0.41, 0.46), ground = vec3(0.22, 0.205, 0.19);
const float from_eye = 0.12;
const float through = 0.3;  // of the light on the other side of cloth

/// Shares of the sky and of the key light, between pixels that are at the depth of this point.
vec2 open_shares() {
  if (!has_occlusion && !has_shadows) return vec2(1.0);
  float depth = 1.0 / gl_FragCoord.w;
  vec2 at = screen_scale * gl_FragCoord.xy - 0.5;
  ivec2 corner = ivec2(floor(at)), last = textureSize(screen_light, 0) - 1;
  vec2 share = at - vec2(corner);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 aside = ivec2(i & 1, i >> 1);
    vec3 seen = texelFetch(screen_light, clamp(corner + aside, ivec2(0), last), 0).rgb;
    vec2 near = mix(1.0 - share, share, vec2(aside));
    float weight = (near.x * near.y + 0.01) / (0.001 + abs(seen.g / depth - 1.0));
    sum += weight * vec3(seen.rb, 1.0);
  }
  return sum.xy / sum.z;
}

vec3 roll_off(vec3 c) {
  const float from = 0.75;
  vec3 over = max(c - from, 0.0) / (1.0 - from);
  return min(c, from) + (1.0 - from) * (1.0 - exp(-over));
}

/// What a polished surface sees in a direction, as in a studio: a floor in light, dark walls, a bright ceiling, and the
/// lamp. Without dark and bright a metal would look like paint.
vec3 seen_towards(vec3 way, float key) {
  vec3 around = mix(1.5 * ground, 0.16 * sky, smoothstep(-0.35, 0.02, way.z));
  around = mix(around, 2.2 * sky, smoothstep(0.12, 0.75, way.z));
  return around + 1.6 * key * key_light * pow(max(dot(way, light), 0.0), 20.0);
}

/// finish: 1 of cloth, whose fibers catch light at grazing angles and let some through; 3 glossy, 4 metal; all else is
/// solid and has a soft highlight.
vec3 lit(vec3 tone, vec3 point, vec3 n, int finish) {
  vec3 to_eye = normalize(eye - point);
  float towards = dot(n, light), sheen = has_cloth && finish == 1 ? 1.0 : 0.0;
  vec2 shares = open_shares();
  float open = shares.x;
  float key = shares.y * max(towards, -through * sheen * towards);
  float facing = clamp(dot(n, to_eye), 0.0, 1.0);
  vec3 around = open * (mix(ground, sky, 0.5 + 0.5 * n.z) + from_eye * facing);
  vec3 base = pow(tone, vec3(2.2));
  vec3 color = base * ((0.6 + 0.4 * open) * key * key_light + around);
  float rim = pow(1.0 - facing, 4.0);
  if (has_gloss && finish >= 3) {
    float lies_in_light = towards > 0.0 ? min(key / max(towards, 0.05), 1.0) : 0.0;
    vec3 seen = (0.3 + 0.7 * open) * seen_towards(reflect(-to_eye, n), lies_in_light);
    float glance = pow(max(dot(n, normalize(light + to_eye)), 0.0), 180.0) * lies_in_light;
    if (finish == 4) color = 0.10 * color + mix(base, vec3(1), 0.6 * rim) * (seen + glance);
    if (finish == 4) return pow(roll_off(color), vec3(0.4545));
    color += (0.06 + 0.5 * rim) * seen + 0.5 * glance * key_light;
    return pow(roll_off(color), vec3(0.4545));
  }
  color += sheen * 0.30 * rim * mix(vec3(1), base, 0.6) * (0.6 * key * key_light + around);
  float glance = max(dot(n, normalize(light + to_eye)), 0.0);
  color += (1.0 - sheen) * (0.10 * key * pow(glance, 40.0) * key_light + 0.10 * rim * open * sky);
  return pow(roll_off(color), vec3(0.4545));
}
)";

const std::string_view depth_vertex = R"(#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 camera, place;
uniform float setback;
out float value_at;  // as line_geometry takes it
out vec4 front_at;
out vec3 place_at;
void main() {
  value_at = 0.0;
  front_at = vec4(0);
  place_at = vec3(0);
  gl_Position = camera * (place * vec4(position, 1));
  gl_Position.z += setback * gl_Position.w;
})";

const std::string_view depth_fragment = R"(#version 330 core
void main() {})";

// Depths of the picture, and normals in space as colors; floors, which have none here, are marked by zero.
const std::string_view screen_depth_vertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 camera, place;
uniform float setback;
out vec3 normal_here;
void main() {
  normal_here = mat3(place) * normal;
  gl_Position = camera * (place * vec4(position, 1));
  gl_Position.z += setback * gl_Position.w;
})";

const std::string_view screen_depth_fragment = R"(#version 330 core
in vec3 normal_here;
out vec4 color;
void main() {
  float size = length(normal_here);
  color = vec4(0.5 + 0.5 * normal_here / max(size, 1e-9), size > 0.1 ? 1.0 : 0.0);
})";

// The same of a rope, behind line_geometry.
const std::string_view rope_screen_depth_fragment = R"(#version 330 core
in float across;
flat in vec3 side_here, outward_here;
uniform float width;
out vec4 color;
void main() {
  if (abs(across) > width / 2.0) discard;
  float t = across / (width / 2.0);
  color = vec4(0.5 + 0.5 * (side_here * t + outward_here * sqrt(1.0 - t * t)), 1);
})";

// After McGuire, Osman, Bukowski and Hennessy, "The Alchemy Screen-Space Ambient Obscurance Algorithm", 2011, eq. 10,
// with the falloff of their "Scalable Ambient Obscurance", 2012.
// Before the programs that find light from the depths of the picture.
const std::string_view depth_reading = R"(#version 330 core
uniform sampler2D depths;
uniform vec4 lens;   // of the projection: 1/m00, 1/m11, m22, m23
uniform float inset; // m02
out vec4 color;

vec3 point_at(ivec2 pixel) {
  ivec2 size = textureSize(depths, 0);
  pixel = clamp(pixel, ivec2(0), size - 1);
  vec2 ndc = (vec2(pixel) + 0.5) / vec2(size) * 2.0 - 1.0;
  float z = -lens.w / (texelFetch(depths, pixel, 0).r * 2.0 - 1.0 + lens.z);
  return vec3(-z * (ndc + vec2(inset, 0)) * lens.xy, z);
}
)";

const std::string_view occlusion_fragment = R"(
uniform float reach;   // how far away what occludes is looked for [m]
uniform float pixels;  // of this picture, that 1 m at a distance of 1 m has

/// Of two neighbors the one that lies nearer is on the same surface.
vec3 slope(vec3 here, ivec2 at, ivec2 along) {
  vec3 a = here - point_at(at - along), b = point_at(at + along) - here;
  return abs(a.z) < abs(b.z) ? a : b;
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  const int step_size = 2;  // from pixel to pixel of this picture in that of the depths
  if (texelFetch(depths, step_size * at, 0).r == 1.0) {
    color = vec4(1, 6e4, 0, 1);
    return;
  }
  vec3 here = point_at(step_size * at);
  ivec2 pixel = step_size * at;
  vec3 n = normalize(cross(slope(here, pixel, ivec2(1, 0)), slope(here, pixel, ivec2(0, 1))));
  const int count = 12;
  float radius = min(pixels * reach / -here.z, 120.0);
  float angle = 6.2831853 * fract(0.25 * float(((at.x & 3) + 4 * (at.y & 3)) * 5 % 16) / 4.0);
  mat2 turn = radius * mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
  float sum = 0.0;
  for (int i = 0; i < count; ++i) {
    float far = (float(i) + 0.5) / float(count);
    vec2 aside = turn * (far * vec2(cos(2.39996 * float(i)), sin(2.39996 * float(i))));
    vec3 v = point_at(step_size * (at + ivec2(aside))) - here;
    float square = dot(v, v), left = max(1.0 - square / (reach * reach), 0.0);
    sum += left * left * left * max(dot(v, n) + 0.004 * here.z, 0.0) / (square + 1e-4 * reach * reach) * reach;
  }
  color = vec4(clamp(1.0 - 1.5 * sum / float(count), 0.0, 1.0), -here.z, 0, 1);
})";

// The directions looked at differ in squares of 4 by 4 pixels, over which this takes the mean of one surface.
const std::string_view occlusion_blur_fragment = R"(#version 330 core
uniform sampler2D occlusion;
uniform int side, corner;  // of the square [pixels], and where it begins, beside the pixel
out vec4 color;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(occlusion, 0) - 1;
  float depth = texelFetch(occlusion, at, 0).g, sum = 0.0, weights = 0.0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      vec2 seen = texelFetch(occlusion, clamp(at + corner + ivec2(x, y), ivec2(0), last), 0).rg;
      float weight = max(1e-3, 1.0 - 12.0 * abs(seen.g / depth - 1.0));
      sum += weight * seen.r;
      weights += weight;
    }
  }
  color = vec4(sum / weights, depth, 0, 1);
})";

// Puts together what light a pixel is in: the share of the sky, between the pixels of the smaller picture that are as
// far away, and that of the key light.
const std::string_view screen_light_fragment = R"(
uniform sampler2D occlusion;
uniform sampler2DShadow shadow_map;  // depths as the light sees them
uniform sampler2D normals;
uniform int has_shadows;
uniform mat4 to_shadow_map;          // from what the eye sees to its texture
uniform mat3 view;                   // from space to what the eye sees
uniform float texel;                 // of the map [m]
uniform vec3 light;                  // as the eye sees it

float sky_share(ivec2 pixel, float depth) {
  vec2 at = (vec2(pixel) + 0.5) / 2.0 - 0.5;
  ivec2 corner = ivec2(floor(at)), last = textureSize(occlusion, 0) - 1;
  vec2 share = at - vec2(corner);
  float sum = 0.0, weights = 0.0;
  for (int i = 0; i < 4; ++i) {
    ivec2 aside = ivec2(i & 1, i >> 1);
    vec2 seen = texelFetch(occlusion, clamp(corner + aside, ivec2(0), last), 0).rg;
    vec2 near = mix(1.0 - share, share, vec2(aside));
    float weight = (near.x * near.y + 0.01) / (0.001 + abs(seen.g / depth - 1.0));
    sum += weight * seen.r;
    weights += weight;
  }
  return sum / weights;
}

/// Sixteen places in a disc of three texels; where the four outer ones agree, the others would too. Cloth is lit from
/// either side. A loop, which a processor leaves where a branch would be gone through all the same.
float key_share(vec3 point, vec3 n, bool is_wanted) {
  float towards = dot(n, light), slant = sqrt(1.0 - min(towards * towards, 1.0));
  vec3 from = point + (towards < 0.0 ? -n : n) * (texel * (1.0 + 2.5 * slant));
  vec3 at = (to_shadow_map * vec4(from, 1)).xyz;
  vec2 way = vec2(3.0 / float(textureSize(shadow_map, 0).x), 0.0);
  const mat2 golden_angle = mat2(-0.737369, 0.675490, -0.675490, -0.737369);
  float sum = 0.0;
  int last = is_wanted ? 12 : 16;
  for (int i = 15; i >= last; --i) {
    sum += textureLod(shadow_map, vec3(at.xy + sqrt((float(i) + 0.5) / 16.0) * way, at.z), 0.0);
    way = golden_angle * way;
    if (i == 12 && sum > 0.001 && sum < 3.999) last = 0;
  }
  return is_wanted ? sum / float(16 - last) : 1.0;
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  if (texelFetch(depths, at, 0).r == 1.0) {
    color = vec4(1, 6e4, 1, 1);
    return;
  }
  vec3 here = point_at(at);
  color = vec4(sky_share(at, -here.z), -here.z, 1, 1);
  vec4 normal = texelFetch(normals, at, 0);
  color.b = key_share(here, view * normalize(2.0 * normal.xyz - 1.0), has_shadows != 0 && normal.a > 0.5);
})";

// The mean of all samples of a pixel.
const std::string_view resolve_fragment = R"(
uniform SAMPLER picture;
out vec4 color;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 sum = vec3(0);
  for (int i = 0; i < factor * factor; ++i) {
    ivec2 from = factor * at + ivec2(i % factor, i / factor);
    for (int j = 0; j < samples; ++j) sum += texelFetch(picture, from, j).rgb;
  }
  color = vec4(sum / float(factor * factor * samples), 1);
})";

}  // namespace pliant_render::shaders
