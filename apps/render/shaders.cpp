#include "render/shaders.h"

namespace pliant_render::shaders {

const std::string_view surface_vertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float value;
layout(location = 3) in vec4 front;
layout(location = 4) in vec4 back;
layout(location = 5) in vec4 second;
layout(location = 6) in vec3 in_pattern;
layout(location = 7) in float threads;
uniform mat4 camera;
out vec3 point_here, normal_here, in_pattern_here;
out float value_here;
flat out vec4 front_here, back_here, second_here;
flat out float threads_here;
void main() {
  point_here = position;
  normal_here = normal;
  value_here = value;
  in_pattern_here = in_pattern;
  front_here = front;
  back_here = back;
  second_here = second;
  threads_here = threads;
  gl_Position = camera * vec4(position, 1);
})";

// The back of a sheet is lit as its front. Comes after `lighting`. Front, back and second are as in VertexLook.
const std::string_view surface_fragment = R"(
in vec3 point_here, normal_here, in_pattern_here;
in float value_here;
flat in vec4 front_here, back_here, second_here;
flat in float threads_here;
uniform vec3 held;
uniform int held_finish;  // of colliders
uniform vec3 fronts[7], backs[7];  // of body_tones
uniform float low, high;
uniform sampler2D colors, picture;
out vec4 color;

/// 1 and -1 in turn between whole numbers, and on the way where a pixel has both.
vec3 in_turn(vec3 at) {
  vec3 away = abs(mod(at + 0.5, 2.0) - 1.0) - 0.5;
  return clamp(away / max(fwidth(at), 1e-5), -0.5, 0.5) * 2.0;
}

/// A place in the plane of two axes, the one that the surface lies along most at rest.
vec2 laid(vec3 at) {
  vec3 n = abs(cross(dFdx(at), dFdy(at)));
  const float clearly = 1.01;  // more, so that rounding does not choose
  if (clearly * n.z >= max(n.x, n.y)) return at.xy;
  return clearly * n.y >= n.x ? at.xz : at.yz;
}

vec3 own_tone(vec2 here) {
  int pattern = int(255.0 * back_here.a + 0.5);
  if (has_gradient && pattern == 3) {
    float share = clamp(in_pattern_here.x, -1.0, 1.0);
    return mix(front_here.rgb, share < 0.0 ? back_here.rgb : second_here.rgb, abs(share));
  }
  vec3 base = gl_FrontFacing ? front_here.rgb : back_here.rgb;
  if (pattern == 0) return base;
  if (has_picture && pattern >= 4) {
    if ((pattern == 5 || pattern == 7) && !gl_FrontFacing) return base;
    vec2 size = vec2(textureSize(picture, 0));
    vec4 seen = texture(picture, vec2(here.x, -here.y * (pattern >= 6 ? 1.0 : size.x / size.y)));  // rows go down
    return base * (1.0 - seen.a) + seen.rgb;
  }
  if (!has_fields) return base;
  vec3 turns = in_turn(in_pattern_here);
  float turn = pattern == 1 ? turns.x * turns.y * turns.z : turns.x;
  return mix(base, second_here.rgb, 0.5 + 0.5 * turn);
}

/// Plain weave: in each square of threads one way lies on top, in its neighbors the other. Fades where a thread has
/// less than some pixels. Bends the normal, and gives how dark it is between threads.
float weave(vec2 at, inout vec3 n) {
  vec3 px = dFdx(point_here), py = dFdy(point_here);
  vec2 x = dFdx(at), y = dFdy(at);
  float width = max(length(x), length(y)), fade = 1.0 - smoothstep(0.12, 0.4, width);
  float area = x.x * y.y - x.y * y.x;
  if (fade <= 0.0 || abs(area) < 1e-12) return 1.0;
  vec3 along = (px * y.y - py * x.y) / area, across = (py * x.x - px * y.x) / area;
  vec2 square = floor(at), inside = at - square - 0.5;
  bool is_along = mod(square.x + square.y, 2.0) < 1.0;
  vec2 slope = is_along ? vec2(0.6 * inside.x, 1.7 * inside.y) : vec2(1.7 * inside.x, 0.6 * inside.y);
  n = normalize(n + fade * (slope.x * normalize(along) + slope.y * normalize(across)));
  float edge = is_along ? abs(inside.y) : abs(inside.x), end = is_along ? abs(inside.x) : abs(inside.y);
  return 1.0 + fade * (0.06 - 0.32 * smoothstep(0.3, 0.5, edge) - 0.12 * smoothstep(0.2, 0.5, end));
}

void main() {
  vec3 n = normalize(normal_here + 1e-9 * (eye - point_here));  // never of length zero
  if (!gl_FrontFacing) n = -n;
  vec2 here = has_picture || has_weave ? laid(in_pattern_here) : vec2(0);
  vec3 tone = held;
  int finish = is_solid ? held_finish : int(255.0 * second_here.a + 0.5);
  if (is_colored) {
    finish = min(finish, 2);  // what reflects would change what colors tell
    float place = clamp((value_here - low) / (high - low), 0.002, 0.998);
    tone = textureLod(colors, vec2(place, 0.5), 0.0).rgb;
  } else if (has_looks && front_here.a > 0.5) {
    tone = own_tone(here);
  } else if (!is_solid && value_here > -0.5) {
    int number = int(value_here + 0.5);
    tone = gl_FrontFacing ? fronts[number] : backs[number];
  }
  if (has_weave && threads_here > 0.0) tone *= weave(threads_here * here, n);
  color = vec4(dithered(lit(tone, point_here, n, finish)), 1);
})";

const std::string_view solid_vertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 camera, place;
uniform float setback;
out vec3 point_here, normal_here, in_pattern_here;
out float value_here;
flat out vec4 front_here, back_here, second_here;
flat out float threads_here;
void main() {
  threads_here = 0.0;
  point_here = (place * vec4(position, 1)).xyz;
  normal_here = mat3(place) * normal;
  value_here = -1.0;  // held
  in_pattern_here = vec3(0);
  front_here = back_here = second_here = vec4(0);
  gl_Position = camera * vec4(point_here, 1);
  gl_Position.z += setback * gl_Position.w;
})";

// Each face by itself: its own normal at its three corners.
const std::string_view flat_vertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 2) in float value;
layout(location = 3) in vec4 front;
layout(location = 4) in vec4 back;
layout(location = 5) in vec4 second;
layout(location = 6) in vec3 in_pattern;
layout(location = 7) in float threads;
uniform mat4 camera;
out vec3 place, in_pattern_at;
out float value_at, threads_at;
out vec4 front_at, back_at, second_at;
void main() {
  place = position;
  value_at = value;
  in_pattern_at = in_pattern;
  front_at = front;
  back_at = back;
  second_at = second;
  threads_at = threads;
  gl_Position = camera * vec4(position, 1);
})";

const std::string_view flat_geometry = R"(#version 330 core
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
in vec3 place[], in_pattern_at[];
in float value_at[], threads_at[];
in vec4 front_at[], back_at[], second_at[];
out vec3 point_here, normal_here, in_pattern_here;
out float value_here;
flat out vec4 front_here, back_here, second_here;
flat out float threads_here;
void main() {
  vec3 normal = cross(place[1] - place[0], place[2] - place[0]);
  float area = length(normal);
  for (int i = 0; i < 3; ++i) {
    point_here = place[i];
    normal_here = area > 0.0 ? normal / area : vec3(0);
    value_here = value_at[i];
    in_pattern_here = in_pattern_at[i];
    front_here = front_at[i];
    back_here = back_at[i];
    second_here = second_at[i];
    threads_here = threads_at[i];
    gl_Position = gl_in[i].gl_Position;
    EmitVertex();
  }
  EndPrimitive();
})";

const std::string_view stroke_vertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 2) in float value;
layout(location = 3) in vec4 front;
uniform mat4 camera;
out float value_at;
out vec4 front_at;
out vec3 place_at;
void main() {
  value_at = value;
  front_at = front;
  place_at = position;
  gl_Position = camera * vec4(position, 1);
})";

const std::string_view line_geometry = R"(#version 330 core
layout(lines) in;
layout(triangle_strip, max_vertices = 4) out;
in float value_at[];
in vec4 front_at[];
in vec3 place_at[];
uniform vec2 picture;  // pixels
uniform float width, lift;
uniform vec3 to_right, to_top, to_eye;  // of the picture, in space
out float across, value_here;
out vec3 point_here;
flat out vec3 side_here, outward_here;  // of a tube that faces the eye, in space
flat out vec4 front_here;
void main() {
  vec4 a = gl_in[0].gl_Position, b = gl_in[1].gl_Position;
  float va = value_at[0], vb = value_at[1];
  vec3 pa = place_at[0], pb = place_at[1];
  const float least = 1e-4;
  if (a.w < least && b.w < least) return;
  if (a.w < least) {
    float s = (least - a.w) / (b.w - a.w);
    a = mix(a, b, s);
    va = mix(va, vb, s);
    pa = mix(pa, pb, s);
  }
  if (b.w < least) {
    float s = (least - b.w) / (a.w - b.w);
    b = mix(b, a, s);
    vb = mix(vb, va, s);
    pb = mix(pb, pa, s);
  }
  vec2 along = (b.xy / b.w - a.xy / a.w) * picture;
  float size = length(along);
  along = size > 1e-6 ? along / size : vec2(1, 0);
  vec2 sideways = vec2(-along.y, along.x);
  float reach = width / 2.0 + 0.75;  // half a pixel and some for the soft edge
  vec2 side = sideways * 2.0 * reach / picture;
  for (int end = 0; end < 2; ++end) {
    vec4 p = end == 0 ? a : b;
    p.z -= lift * p.w;
    for (int s = -1; s <= 1; s += 2) {
      across = float(s) * reach;
      side_here = sideways.x * to_right + sideways.y * to_top;
      outward_here = to_eye;
      point_here = end == 0 ? pa : pb;
      value_here = end == 0 ? va : vb;
      front_here = front_at[0];
      gl_Position = p + vec4(float(s) * side * p.w, 0, 0);
      EmitVertex();
    }
  }
  EndPrimitive();
})";

const std::string_view line_fragment = R"(#version 330 core
in float across;
uniform float width, opacity;
uniform vec3 tone;
out vec4 color;
void main() {
  float edge = clamp(width / 2.0 + 0.5 - abs(across), 0.0, 1.0);
  if (edge * opacity < 0.01) discard;
  color = vec4(tone, edge * opacity);
})";

// A line lit as a tube, behind `lighting`.
const std::string_view rope_fragment = R"(
in float across, value_here;
in vec3 point_here;
flat in vec3 side_here, outward_here;
flat in vec4 front_here;
uniform float width, low, high;
uniform vec3 fronts[7];
uniform sampler2D colors;
out vec4 color;
void main() {
  float edge = clamp(width / 2.0 + 0.5 - abs(across), 0.0, 1.0);
  if (edge < 0.01) discard;
  vec3 tone = has_looks && front_here.a > 0.5 ? front_here.rgb : fronts[max(int(value_here + 0.5), 0)];
  if (is_colored) tone = textureLod(colors, vec2(clamp((value_here - low) / (high - low), 0.002, 0.998), 0.5), 0.0).rgb;
  float t = clamp(across / (width / 2.0), -1.0, 1.0);
  color = vec4(lit(tone, point_here, side_here * t + outward_here * sqrt(1.0 - t * t), 2), edge);
})";

const std::string_view marker_geometry = R"(#version 330 core
layout(points) in;
layout(triangle_strip, max_vertices = 4) out;
uniform vec2 picture;
uniform float radius, lift;
out vec2 at;
void main() {
  vec4 p = gl_in[0].gl_Position;
  if (p.w < 1e-4) return;
  p.z -= lift * p.w;
  float reach = radius + 1.0;
  for (int x = -1; x <= 1; x += 2) {
    for (int y = -1; y <= 1; y += 2) {
      at = vec2(x, y) * reach;
      gl_Position = p + vec4(at * 2.0 / picture * p.w, 0, 0);
      EmitVertex();
    }
  }
  EndPrimitive();
})";

const std::string_view marker_fragment = R"(#version 330 core
in vec2 at;
uniform float radius, core_radius;
uniform vec3 tone;
out vec4 color;
void main() {
  float distance = length(at);
  float inside = clamp(radius + 0.5 - distance, 0.0, 1.0);
  if (inside < 0.01) discard;
  float core = clamp(core_radius + 0.5 - distance, 0.0, 1.0);
  color = vec4(mix(vec3(0.13, 0.15, 0.18), tone, core), inside);
})";

}  // namespace pliant_render::shaders
