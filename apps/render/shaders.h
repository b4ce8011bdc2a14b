#pragma once
// The programs of the renderer, in GLSL 3.30.
#include <string>
#include <string_view>

namespace pliant_render::shaders {

// Surfaces in two tones, or colored by a value.
extern const std::string_view surface_vertex;
extern const std::string_view surface_fragment;
extern const std::string_view flat_vertex;
extern const std::string_view flat_geometry;

// How light falls on surfaces: behind the head of a fragment program, see head_of, and before its own part.
extern const std::string_view dithering;
extern const std::string_view lighting;
extern const std::string_view depth_vertex;
extern const std::string_view depth_fragment;
extern const std::string_view screen_depth_vertex;
extern const std::string_view screen_depth_fragment;
extern const std::string_view rope_screen_depth_fragment;
extern const std::string_view depth_reading;
extern const std::string_view occlusion_fragment;
extern const std::string_view occlusion_blur_fragment;
extern const std::string_view screen_light_fragment;
inline std::string reading_depths(std::string_view fragment) {
  return std::string(depth_reading).append(fragment);
}

// Lines as ribbons of a width in pixels, and points as discs.
extern const std::string_view stroke_vertex;
extern const std::string_view line_geometry;
extern const std::string_view line_fragment;
extern const std::string_view rope_fragment;
extern const std::string_view marker_geometry;
extern const std::string_view marker_fragment;

// The shadow: everything flattened onto the ground along the light, then blurred.
extern const std::string_view flatten_vertex;
extern const std::string_view flatten_fragment;
extern const std::string_view screen_vertex;
extern const std::string_view blur_fragment;
extern const std::string_view combine_fragment;

// Colliders that are solids, and planes with the shadow on them, as the ground is one.
extern const std::string_view solid_vertex;
extern const std::string_view plane_vertex;
extern const std::string_view plane_fragment;

// From samples to the pixels of a picture, behind constants: see RenderTarget.
extern const std::string_view resolve_fragment;

}  // namespace pliant_render::shaders
