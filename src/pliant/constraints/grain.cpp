#include "pliant/constraints/grain.h"

#include <algorithm>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "pliant/constraints/build.h"
#include "pliant/core/error.h"

namespace pliant {
namespace {

/// Of the length of a direction: what is shorter within the plane of a triangle is normal to it.
constexpr Real shortest_within = 1e-6;
/// The same for an axis that nobody asked for, where another can be had.
constexpr Real shortest_of_axis = 0.2;

/// The frame of a triangle at rest.
struct Frame {
  Vec3 x, y;
  Real height;  ///< of the third vertex, along y

  Frame(const Positions& rest, std::span<const Index> corners) {
    const Vec3 e1 = row(rest, corners[1]) - row(rest, corners[0]);
    const Vec3 e2 = row(rest, corners[2]) - row(rest, corners[0]);
    x = e1.stableNormalized();
    const Vec3 across = e2 - x.dot(e2) * x;
    height = across.stableNorm();
    y = across.stableNormalized();
  }
  Vec2 within(const Vec3& v) const { return {x.dot(v), y.dot(v)}; }
};

/// Rows of Mesh::texture_coordinates at the corners of each triangle that came from a polygon.
class TextureCorners {
 public:
  explicit TextureCorners(const Mesh& mesh) : mesh_(mesh) {
    const PolygonFaces& faces = mesh.faces;
    if (faces.texture_coordinates.empty()) return;
    for (Index face = 0; face < faces.face_count(); ++face) {
      const auto first = static_cast<std::size_t>(faces.offsets[static_cast<std::size_t>(face)]);
      const auto end = static_cast<std::size_t>(faces.offsets[static_cast<std::size_t>(face) + 1]);
      for (std::size_t corner = first + 2; corner < end; ++corner) {
        const auto of = [&](const std::vector<Index>& list) -> Triangle {
          return {list[first], list[corner - 1], list[corner]};
        };
        const Triangle rows = of(faces.texture_coordinates);
        if (*std::ranges::min_element(rows) >= 0) rows_.emplace(of(faces.vertices), rows);
      }
    }
  }
  bool empty() const { return rows_.empty(); }

  /// The unit direction in which v grows; none where the triangle has no texture coordinates, or they have no area.
  std::optional<Vec2> direction_of_v(std::span<const Index> corners, const Frame& frame) const {
    const auto found = rows_.find({corners[0], corners[1], corners[2]});
    if (found == rows_.end()) return std::nullopt;
    const auto uv = [&](std::size_t j) -> Vec2 { return mesh_.texture_coordinates.row(found->second[j]).transpose(); };
    const Vec2 first = uv(1) - uv(0), second = uv(2) - uv(0);
    const Real area = first[0] * second[1] - first[1] * second[0];
    if (!(std::abs(area) > 1e-9 * first.norm() * second.norm())) return std::nullopt;
    // J (0, 1) with J (first, second) = (e₁, e₂), times |area|.
    const Vec2 e1 = frame.within(row(mesh_.vertices, corners[1]) - row(mesh_.vertices, corners[0]));
    const Vec2 e2 = frame.within(row(mesh_.vertices, corners[2]) - row(mesh_.vertices, corners[0]));
    const Vec2 along = std::copysign(Real(1), area) * (first[0] * e2 - second[0] * e1);
    if (!(along.stableNorm() > 0)) return std::nullopt;
    return along.stableNormalized();
  }

 private:
  const Mesh& mesh_;
  std::map<Triangle, Triangle> rows_;
};

/// The axes of space, the one that lies best in the surface first; where they lie alike, z before x before y.
std::array<Vec3, 3> best_axes(const BodyView& body, const Stencils& triangles) {
  Vec3 out_of_surface = Vec3::Zero();
  for (Index i = 0; i < triangles.size(); ++i) {
    const Vec3 x0 = row(body.rest.vertices, triangles[i][0]);
    const Vec3 n = (row(body.rest.vertices, triangles[i][1]) - x0).cross(row(body.rest.vertices, triangles[i][2]) - x0);
    const Real norm = n.norm();
    if (norm > 0) out_of_surface += n.cwiseProduct(n) / norm;
  }
  const Real alike = 0.05 * out_of_surface.sum();
  std::array<Index, 3> order = {2, 0, 1};
  for (auto place = order.begin(); place != order.end(); ++place) {
    const auto out = [&](Index axis) { return out_of_surface[axis]; };
    const Real least = out(*std::min_element(place, order.end(), [&](Index a, Index b) { return out(a) < out(b); }));
    const auto best = std::find_if(place, order.end(), [&](Index axis) { return out(axis) <= least + alike; });
    std::rotate(place, best, best + 1);
  }
  return {Vec3::Unit(order[0]), Vec3::Unit(order[1]), Vec3::Unit(order[2])};
}

Vec2 along_best_axis(const std::array<Vec3, 3>& axes, const Frame& frame) {
  for (const Vec3& axis : axes) {
    const Vec2 within = frame.within(axis);
    if (within.norm() > shortest_of_axis) return within.normalized();
  }
  return {1, 0};
}

}  // namespace

std::vector<Vec2> warp_directions(std::string_view type, const BodyView& body, const Stencils& triangles,
                                  const Points& direction, Grain grain) {
  check_length(type, "direction", direction, triangles.size());
  const std::string place = fmt::format("{} on body '{}'", type, body.name);
  const bool is_by_direction = !direction.empty();
  const TextureCorners texture(body.rest);
  if (!is_by_direction && grain == Grain::uv && texture.empty()) {
    fail_input(place + ": its mesh has no texture coordinates; export them (`vt` in OBJ), or give a direction");
  }
  const std::array<Vec3, 3> axes = best_axes(body, triangles);
  const auto of_triangle = [&](Index i) -> Vec2 {
    const Frame frame(body.rest.vertices, triangles[i]);
    if (is_by_direction) {
      const Vec3 unit = direction[i].stableNormalized();
      if (!(unit.squaredNorm() > 0)) {
        fail_input(fmt::format("{}: direction {} is the zero vector; give one such as [0, 1, 0]", place,
                               direction.each() ? i : 0));
      }
      const Vec2 within = frame.within(unit);
      if (within.norm() > shortest_within) return within.normalized();
      fail_input(fmt::format("{}: the direction is normal to triangle {}; give one that lies in the cloth", place, i));
    }
    if (grain == Grain::edge) return {1, 0};
    if (const std::optional<Vec2> along_v = texture.direction_of_v(triangles[i], frame)) return *along_v;
    if (grain == Grain::automatic) return along_best_axis(axes, frame);
    fail_input(
        fmt::format("{}: the texture coordinates of triangle {} are missing or have no area; fix them, or give "
                    "a direction",
                    place, i));
  };
  std::vector<Vec2> directions;
  directions.reserve(static_cast<std::size_t>(triangles.size()));
  for (Index i = 0; i < triangles.size(); ++i) directions.push_back(of_triangle(i));
  return directions;
}

}  // namespace pliant
