#pragma once
// A square before a camera, and what is asked of the picture of it.
#include <cmath>
#include <optional>
#include <utility>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant/mesh/shapes.h"
#include "render/picture_maker.h"

namespace pliant_tests {

using Rgb = std::array<int, 3>;

/// Makes it in place; false, after a message, where the machine has no OpenGL.
template <class Made, class... Arguments>
bool make_if_drawable(std::optional<Made>& made, Arguments&&... arguments) {
  try {
    made.emplace(std::forward<Arguments>(arguments)...);
    return true;
  } catch (const pliant::Error& error) {
    MESSAGE("skipped: ", std::string(error.what()));
    return false;
  }
}

/// A square of 1 m that stands upright, its normals towards -y, and a camera before it.
struct Studio {
  std::vector<pliant::Body> bodies;
  pliant_render::PictureOptions options;
  pliant_render::FrameContent frame;
  std::optional<pliant_render::WindAnnotation> wind;

  Studio() {
    pliant::Mesh mesh = pliant::grid({.columns = 9, .rows = 9, .size = {1, 1}});
    for (pliant::Index i = 0; i < mesh.vertex_count(); ++i) {
      const pliant::Vec3 x = mesh.vertices.row(i).transpose();
      const pliant::Real across = x.x(), along = x.y() + x.z();  // whichever way the grid lies
      mesh.vertices.row(i) << across - 0.5, 0, along - 0.5;
    }
    bodies.push_back({"square", mesh, 0});
    for (pliant::Index i = 0; i < mesh.vertex_count(); ++i) {
      frame.positions.push_back(mesh.vertices.row(i).transpose().cast<float>());
    }
    options.appearance.size = {320, 240};
    options.appearance.camera.position = pliant::Vec3(0, -3, 0);
    options.appearance.camera.target = pliant::Vec3(0, 0, 0);
    options.appearance.shadow = options.appearance.ground = false;
    options.bounds = pliant_render::bounds_of(frame.positions);
  }

  /// A rope of 1 m from left to right in place of the square.
  void show_rope() {
    pliant::Mesh rope;
    rope.vertices.resize(2, 3);
    rope.vertices << -0.5, 0, 0, 0.5, 0, 0;
    rope.edges = {{0, 1}};
    bodies = {{"rope", rope, 0}};
    frame.positions = {{-0.5F, 0, 0}, {0.5F, 0, 0}};
  }

  /// None where the machine has no OpenGL.
  std::optional<pliant_render::Image> draw() const {
    std::optional<pliant_render::PictureMaker> maker;
    if (!make_if_drawable(maker, pliant_render::make_render_mesh(bodies), options)) return {};
    return maker->draw(frame, wind);
  }
};

/// u, v: from -1 to 1, as normalized device coordinates.
inline Rgb at(const pliant_render::Image& image, double u, double v) {
  const auto x = static_cast<std::size_t>((u + 1) / 2 * (image.width - 1) + 0.5);
  const auto y = static_cast<std::size_t>((1 - v) / 2 * (image.height - 1) + 0.5);
  const std::uint8_t* pixel = image.pixels.data() + 3 * (y * static_cast<std::size_t>(image.width) + x);
  return {pixel[0], pixel[1], pixel[2]};
}

inline int distance(const Rgb& a, const Rgb& b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

inline Rgb rgb(const pliant::Color& color) {
  return {static_cast<int>(std::lround(255 * color.red)), static_cast<int>(std::lround(255 * color.green)),
          static_cast<int>(std::lround(255 * color.blue))};
}

/// Share of pixels in which two pictures differ visibly.
inline double difference(const pliant_render::Image& a, const pliant_render::Image& b) {
  REQUIRE(a.pixels.size() == b.pixels.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i + 2 < a.pixels.size(); i += 3) {
    int sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += std::abs(int{a.pixels[i + c]} - int{b.pixels[i + c]});
    count += sum > 12;
  }
  return static_cast<double>(count) / (static_cast<double>(a.pixels.size()) / 3);
}

}  // namespace pliant_tests
