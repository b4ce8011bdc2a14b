// Floors: the shadow on them, which is flattened along the light and blurred.
#include "render/shaders.h"

namespace pliant_render::shaders {

const std::string_view flatten_vertex = R"(#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 place;  // to the frame of the floor, where the light is given too
uniform vec3 light;
uniform vec2 middle, reach;
uniform float spreads;  // how wide the shadow is blurred, in its least widths, for 1 m above the floor [1/m]
out float value_at, value_here;  // as line_geometry takes it, and as the fragment does: such widths
out vec4 front_at;
out vec3 place_at;
void main() {
  front_at = vec4(0);
  place_at = vec3(0);
  vec3 p = (place * vec4(position, 1)).xyz;
  value_at = value_here = spreads * p.z;
  p -= light * (max(p.z, 0.0) / light.z);
  gl_Position = vec4((p.xy - middle) / reach, 0, 1);
})";

// Each level of blur is a channel, twice as wide as the one before; what lies between two has a share of both.
const std::string_view flatten_fragment = R"(#version 330 core
in float value_here;
out vec4 color;
void main() {
  float level = min(log2(max(value_here, 1.0)), 3.0);
  color = max(1.0 - abs(level - vec4(0, 1, 2, 3)), 0.0);
})";

const std::string_view screen_vertex = R"(#version 330 core
out vec2 place;
void main() {
  place = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(4.0 * place - 1.0, 0, 1);
  place *= 2.0;
})";

const std::string_view blur_fragment = R"(#version 330 core
in vec2 place;
uniform sampler2D mask;
uniform float level;
uniform vec4 channel;
uniform vec2 step_size;
out vec4 color;
void main() {
  // Seven of a bell's values, in pairs: a place between two texels has both.
  const float weights[3] = float[](0.2623, 0.1234, 0.0351);
  const float places[3] = float[](1.4415, 3.3661, 5.3638);
  vec4 sum = 0.1585 * textureLod(mask, place, level);
  for (int i = 0; i < 3; ++i) {
    vec2 aside = places[i] * step_size;
    sum += weights[i] * (textureLod(mask, place + aside, level) + textureLod(mask, place - aside, level));
  }
  color = vec4(dot(sum, channel), 0, 0, 1);
})";

// Rings about the middle of the scene, of which the outer ones are wider.
const std::string_view plane_vertex = R"(#version 330 core
uniform mat4 camera, place;
uniform vec3 center;
uniform float extent, setback;
uniform int rings, sectors;
out vec2 on_plane;
out float opacity;
void main() {
  float far = float(gl_InstanceID + (gl_VertexID & 1)) / float(rings);
  far *= far;
  float angle = 6.2831853 * float(gl_VertexID >> 1) / float(sectors);
  on_plane = center.xy + extent * far * vec2(cos(angle), sin(angle));
  opacity = 1.0 - smoothstep(0.12, 1.0, far);
  gl_Position = camera * (place * vec4(on_plane, 0, 1));
  gl_Position.z += setback * gl_Position.w;
})";

// Behind the head of a fragment program. Fades into the background; where something else may be behind it, so that this
// shows.
const std::string_view plane_fragment = R"(
in vec2 on_plane;
in float opacity;
uniform vec3 tone, background;
uniform vec2 middle, reach;
uniform float darkness;
uniform bool is_last;             // nothing is behind it
uniform sampler2D mask, screen_light;
uniform vec2 to_screen;           // from pixels drawn to 0 to 1 in the picture
out vec4 color;
void main() {
  float light = 1.0;
  if (has_shadows) light -= darkness * textureLod(mask, (on_plane - middle) / reach / 2.0 + 0.5, 0.0).r;
  if (has_occlusion) light *= 0.4 + 0.6 * textureLod(screen_light, to_screen * gl_FragCoord.xy, 0.0).r;
  float share = is_last ? opacity : 1.0;
  color = vec4(dithered(mix(background, tone, share) * light), is_last ? 1.0 : opacity);
})";

// The farther above the floor something is, the more light of the sky comes in below it.
const std::string_view combine_fragment = R"(#version 330 core
in vec2 place;
uniform sampler2D first, second, third, fourth;
out vec4 color;
void main() {
  vec4 layers = vec4(textureLod(first, place, 0.0).r, textureLod(second, place, 0.0).r, textureLod(third, place, 0.0).r,
                     textureLod(fourth, place, 0.0).r);
  color = vec4(min(dot(layers, vec4(1.0, 0.96, 0.86, 0.72)), 1.0), 0, 0, 1);
})";

}  // namespace pliant_render::shaders
