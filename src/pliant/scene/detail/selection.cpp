#include "pliant/scene/detail/selection.h"

#include <algorithm>
#include <array>
#include <functional>

#include <fmt/format.h>

#include "pliant/mesh/geometry.h"
#include "pliant/mesh/topology.h"
#include "pliant/scene/detail/json_values.h"
#include "pliant/scene/nearest_names.h"

namespace pliant {
namespace {

/// "Included" allows for the rounding of positions, relative to the body's size.
constexpr Real tolerance = 1e-9;

std::vector<Index> vertices_where(const Positions& x, auto&& predicate) {
  std::vector<Index> chosen;
  for (Index i = 0; i < x.rows(); ++i) {
    if (predicate(row(x, i))) chosen.push_back(i);
  }
  return chosen;
}

std::vector<Index> corners(const Positions& x) {
  const BoundingBox box = bounding_box(x);
  const Real slack = tolerance * box.diagonal();
  return vertices_where(x, [&](const Vec3& p) {
    return ((p - box.min).cwiseAbs().cwiseMin((p - box.max).cwiseAbs()).array() <= slack).all();
  });
}

std::vector<Index> in_box(const Node& node, const SceneBody& body) {
  node.check_keys({"min", "max"});
  Vec3 min;
  Vec3 max;
  read(node.require("min"), min);
  read(node.require("max"), max);
  if ((min.array() > max.array()).any()) node.fail("min is above max; exchange them");
  const Real slack = tolerance * bounding_box(body.mesh.vertices).diagonal();
  return vertices_where(body.mesh.vertices, [&](const Vec3& p) {
    return (p.array() >= min.array() - slack).all() && (p.array() <= max.array() + slack).all();
  });
}

std::vector<Index> in_half_space(const Node& node, const SceneBody& body) {
  node.check_keys({"point", "normal"});
  Vec3 point;
  Vec3 normal;
  read(node.require("point"), point);
  read(node.require("normal"), normal);
  const Real length = normal.stableNorm();
  if (!(length > 0)) node.require("normal").fail("a normal of length 0 has no direction; give another");
  const Real slack = tolerance * bounding_box(body.mesh.vertices).diagonal();
  return vertices_where(body.mesh.vertices, [&](const Vec3& p) { return (p - point).dot(normal / length) >= -slack; });
}

std::vector<Index> nearest(const Node& node, const SceneBody& body) {
  Points points;
  read(node, points);
  std::vector<Index> chosen;
  for (const Vec3& point : points.list()) {
    Index best = 0;
    (body.mesh.vertices.rowwise() - point.transpose()).rowwise().squaredNorm().minCoeff(&best);
    chosen.push_back(best);
  }
  return chosen;
}

struct ByName {
  std::string_view name;
  std::vector<Index> (*choose)(const SceneBody&);
};
constexpr std::array by_name = {
    ByName{"boundary", [](const SceneBody& body) { return boundary_vertices(body.mesh); }},
    ByName{"corners", [](const SceneBody& body) { return corners(body.untransformed); }},
};

struct ByPlace {
  std::string_view key;
  std::vector<Index> (*choose)(const Node&, const SceneBody&);
};
constexpr std::array by_place = {ByPlace{"box", in_box}, ByPlace{"half_space", in_half_space},
                                 ByPlace{"nearest", nearest}};

std::vector<Index> named(const Node& node, const SceneBody& body) {
  std::string name;
  read(node, name);
  const auto found = std::ranges::find(by_name, std::string_view(name), &ByName::name);
  if (found == by_name.end()) {
    node.fail(fmt::format("'{}' is no selection; known: {}, a list of vertices, {{\"box\": ...}}", printable(name),
                          nearest_names_text(name, {"all", "boundary", "corners"})));
  }
  return found->choose(body);
}

std::vector<Index> placed(const Node& node, const SceneBody& body) {
  std::vector<std::string_view> keys;
  for (const ByPlace& entry : by_place) keys.push_back(entry.key);
  node.check_keys(keys);
  const std::string_view key = node.require_one_of(keys);
  return std::ranges::find(by_place, key, &ByPlace::key)->choose(node.require(key), body);
}

}  // namespace

Selection read_selection(const Node& node, const SceneBody& body) {
  if (node.is_text() && node.text() == "all") return {};
  if (node.is_list()) return read_vertices(node, body.mesh.vertex_count());
  if (!node.is_text() && !node.is_object()) node.fail_type("\"all\", a list of vertices, or {\"box\": ...}");
  std::vector<Index> vertices = node.is_text() ? named(node, body) : placed(node, body);
  if (vertices.empty()) {
    const BoundingBox box = bounding_box(body.mesh.vertices);
    node.fail(fmt::format("no vertex is selected; the body spans ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g})", box.min[0],
                          box.min[1], box.min[2], box.max[0], box.max[1], box.max[2]));
  }
  return vertices;
}

}  // namespace pliant
