#include "render/picture_places.h"

#include <cmath>
#include <map>
#include <span>

#include "render/body_looks.h"

namespace pliant_render {
namespace {

using pliant::Index;
using pliant::Real;
using pliant::Vec3;
using Axes = std::array<Eigen::Index, 3>;

constexpr int pattern_pixels = 128;  // of a picture of two fields each way

/// Where a picture begins on a body at rest, and how far it reaches before it repeats.
struct Laying {
  Vec3 start;               ///< of one repetition [m]
  Real width = 1;           ///< [m]
  Real height = 1;          ///< [m]
  Real field = 0;           ///< of a checker [m]; 0: of what goes by two axes alone
  Axes axes{};              ///< by length
  bool is_one_way = false;  ///< whether only the first axis counts
};

Laying laying_of(const pliant::Positions& rest, const pliant::BodyAppearance& appearance, std::array<int, 2> size) {
  Laying laying;
  laying.axes = axes_by_length(rest);
  laying.start = rest.colwise().minCoeff().transpose();
  if (!appearance.texture.empty()) {
    laying.width = appearance.texture_size;
    laying.height = appearance.texture_size * size[1] / size[0];
    return laying;
  }
  const Real period = 2 * appearance.pattern_size;
  laying.width = laying.height = period;
  const Real off = off_the_edge * appearance.pattern_size;
  // Whole periods on, so that the coordinates are small numbers.
  for (Real& start : laying.start) start = period * std::floor((start + off) / period) - off;
  if (appearance.pattern == pliant::Pattern::checker) laying.field = appearance.pattern_size;
  laying.is_one_way = appearance.pattern == pliant::Pattern::stripes;
  return laying;
}

/// The number in `axes` of the one that the normal of a polygon is most along; of several the shorter one.
std::size_t axis_across(const pliant::Positions& rest, std::span<const Index> corners, const Axes& axes) {
  Vec3 normal = Vec3::Zero();
  const Vec3 first = rest.row(corners[0]).transpose();
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Vec3 last = rest.row(corners[i - 1]).transpose(), next = rest.row(corners[i]).transpose();
    normal += (last - first).cross(next - first);
  }
  constexpr Real clearly = 1.01;  // more, so that rounding does not choose
  std::size_t across = 2;
  for (const std::size_t k : {std::size_t{1}, std::size_t{0}}) {
    if (std::abs(normal[axes[k]]) > clearly * std::abs(normal[axes[across]])) across = k;
  }
  return across;
}

/// Numbers pairs of coordinates, equal ones alike.
class PairNumbers {
 public:
  Index number(Real u, Real v) {
    const auto [known, is_new] = numbers_.try_emplace({u, v}, static_cast<Index>(pairs_.size()));
    if (is_new) pairs_.push_back({u, v});
    return known->second;
  }

  void hand_to(pliant::Mesh& mesh) const {
    mesh.texture_coordinates.resize(static_cast<Eigen::Index>(pairs_.size()), 2);
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      mesh.texture_coordinates.row(static_cast<Eigen::Index>(i)) << pairs_[i][0], pairs_[i][1];
    }
  }

 private:
  std::map<std::pair<Real, Real>, Index> numbers_;
  std::vector<std::array<Real, 2>> pairs_;
};

void lay_at_rest(pliant::Mesh& mesh, const pliant::Positions& rest, const Laying& laying) {
  pliant::PolygonFaces& faces = mesh.faces;
  faces.texture_coordinates.clear();
  PairNumbers pairs;
  for (std::size_t face = 1; face < faces.offsets.size(); ++face) {
    const auto first = static_cast<std::size_t>(faces.offsets[face - 1]);
    const auto corners =
        std::span(faces.vertices).subspan(first, static_cast<std::size_t>(faces.offsets[face]) - first);
    const std::size_t across = laying.is_one_way ? 2 : axis_across(rest, corners, laying.axes);
    const Eigen::Index right = laying.axes[across == 0 ? 1 : 0], up = laying.axes[across == 2 ? 1 : 2];
    Real shift = 0;
    if (laying.field > 0) {
      const Eigen::Index axis = laying.axes[across];
      Real middle = 0;
      for (const Index vertex : corners) middle += rest(vertex, axis) / static_cast<Real>(corners.size());
      const Real layer = std::floor((middle - laying.start[axis]) / laying.field);
      if (std::fmod(std::abs(layer), 2) == 1) shift = 0.5;  // by a field
    }
    for (const Index vertex : corners) {
      faces.texture_coordinates.push_back(
          pairs.number((rest(vertex, right) - laying.start[right]) / laying.width + shift,
                       laying.is_one_way ? 0.5 : (rest(vertex, up) - laying.start[up]) / laying.height));
    }
  }
  pairs.hand_to(mesh);
}

}  // namespace

Image pattern_image(pliant::Pattern pattern, const pliant::Color& base, const pliant::Color& second) {
  Image image{pattern_pixels, pattern_pixels, {}};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const bool is_right = x >= image.width / 2, is_upper = y < image.height / 2;
      const bool is_second = pattern == pliant::Pattern::checker ? is_right != is_upper : is_right;
      const pliant::Color& color = is_second ? second : base;
      for (const Real share : {color.red, color.green, color.blue}) {
        image.pixels.push_back(static_cast<std::uint8_t>(std::lround(255 * share)));
      }
    }
  }
  return image;
}

bool lies_by_coordinates(const pliant::BodyAppearance& appearance, const pliant::Mesh& mesh) {
  if (mesh.faces.texture_coordinates.empty() || mesh.texture_coordinates.rows() == 0) return false;
  if (appearance.mapping == pliant::Mapping::automatic) return !appearance.texture.empty();
  return appearance.mapping == pliant::Mapping::uv;
}

void lay_picture(pliant::Mesh& mesh, const pliant::Positions& rest, const pliant::BodyAppearance& appearance,
                 std::array<int, 2> size) {
  if (lies_by_coordinates(appearance, mesh)) {
    const bool has_texture = !appearance.texture.empty();
    mesh.texture_coordinates /= has_texture ? appearance.texture_size : 2 * appearance.pattern_size;
    return;
  }
  lay_at_rest(mesh, rest, laying_of(rest, appearance, size));
}

}  // namespace pliant_render
