#include "pliant_io/scene/detail/selection.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "pliant/mesh/geometry.h"
#include "pliant/mesh/nearest_vertex.h"
#include "pliant/mesh/topology.h"
#include "pliant_io/scene/detail/json_values.h"
#include "pliant_io/scene/detail/read_map.h"
#include "pliant_io/scene/nearest_names.h"

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

std::vector<Index> flagged(const std::vector<char>& flags) {
  std::vector<Index> chosen;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (flags[i] != 0) chosen.push_back(static_cast<Index>(i));
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

/// How far beyond its limits "included" goes [m].
Real slack_of(const SceneBody& body) {
  const NearestVertex::Box bounds = body.places().bounds();
  return tolerance * BoundingBox{bounds.min(), bounds.max()}.diagonal();
}

std::vector<Index> in_box(const Node& node, const SceneBody& body) {
  node.check_keys({"min", "max"});
  Vec3 min;
  Vec3 max;
  read(node.require("min"), min);
  read(node.require("max"), max);
  if ((min.array() > max.array()).any()) node.fail("min is above max; swap them");
  const Real slack = slack_of(body);
  return body.places().inside((min.array() - slack).matrix(), (max.array() + slack).matrix());
}

std::vector<Index> in_half_space(const Node& node, const SceneBody& body) {
  node.check_keys({"point", "normal"});
  Vec3 point;
  Vec3 normal;
  read(node.require("point"), point);
  read(node.require("normal"), normal);
  const Real length = normal.stableNorm();
  if (!(length > 0)) node.require("normal").fail("a normal of length 0 has no direction; give another");
  const Real slack = slack_of(body);
  return vertices_where(body.mesh.vertices, [&](const Vec3& p) { return (p - point).dot(normal / length) >= -slack; });
}

std::vector<Index> nearest(const Node& node, const SceneBody& body) {
  Points points;
  read(node, points);
  std::vector<Index> chosen;
  const Index carried = body.mesh.embedding.carried_count();
  for (const Vec3& point : points.list()) {
    const Index end = carried > 0 ? carried : body.mesh.vertex_count();  // those of a lattice are nobody's choice
    chosen.push_back(body.places()(point, end));
  }
  return chosen;
}

/// The number of the loop with the vertex nearest to a point; of several the first.
std::size_t nearest_loop(const Node& node, const std::vector<std::vector<Index>>& loops, const Positions& x) {
  node.check_keys({"nearest"});
  Vec3 point;
  read(node.require("nearest"), point);
  std::size_t found = 0;
  Real least = std::numeric_limits<Real>::infinity();
  for (std::size_t i = 0; i < loops.size(); ++i) {
    for (const Index vertex : loops[i]) {
      const Real squared = (row(x, vertex) - point).squaredNorm();
      if (squared < least) {
        least = squared;
        found = i;
      }
    }
  }
  return found;
}

std::vector<Index> in_boundary_loop(const Node& node, const SceneBody& body) {
  std::vector<std::vector<Index>> loops = boundary_loops(boundary_edges(body.mesh));
  if (loops.empty()) node.fail("the triangles of the body have no boundary; select its vertices in another way");
  std::int64_t number = 0;
  if (node.is_object()) {
    number = static_cast<std::int64_t>(nearest_loop(node, loops, body.mesh.vertices));
  } else {
    if (!node.is_number()) node.fail_type("the number of a loop, or {\"nearest\": [x, y, z]}");
    read(node, number);
    if (number < 0 || number >= static_cast<std::int64_t>(loops.size())) {
      node.fail(fmt::format("there is no boundary loop {}; the body has loops 0 to {}, as `pliant info` lists them",
                            number, loops.size() - 1));
    }
  }
  std::vector<Index> chosen = std::move(loops[static_cast<std::size_t>(number)]);
  std::ranges::sort(chosen);
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());  // a walk may cross itself
  return chosen;
}

[[noreturn]] void fail_no_group(const Node& node, const std::string& name, const Mesh& mesh) {
  std::set<std::string_view> names;
  for (const FaceGroup& group : mesh.groups) names.insert(group.name);
  for (const VertexGroup& group : mesh.vertex_groups) names.insert(group.name);
  if (names.empty()) {
    node.fail("the mesh has no groups; select by place, name its parts, or take a mesh from OBJ that has some");
  }
  node.fail(fmt::format("the mesh has no group, object, material or part '{}'; {}", printable(name),
                        suggestion_text(name, {names.begin(), names.end()})));
}

/// The corners of the faces in every group, object or material of that name, and the vertices of the part.
std::vector<Index> in_group(const Node& node, const SceneBody& body) {
  std::string name;
  read(node, name);
  const Mesh& mesh = body.mesh;
  std::vector<char> flags(static_cast<std::size_t>(mesh.vertex_count()), 0);
  bool found = false;
  for (const FaceGroup& group : mesh.groups) {
    if (group.name != name) continue;
    found = true;
    for (const Index face : group.faces) {
      const auto f = static_cast<std::size_t>(face);
      for (Index c = mesh.faces.offsets[f]; c < mesh.faces.offsets[f + 1]; ++c) {
        flags[static_cast<std::size_t>(mesh.faces.vertices[static_cast<std::size_t>(c)])] = 1;
      }
    }
  }
  for (const VertexGroup& group : mesh.vertex_groups) {
    if (group.name != name) continue;
    found = true;
    for (const Index vertex : group.vertices) flags[static_cast<std::size_t>(vertex)] = 1;
  }
  if (!found) fail_no_group(node, name, mesh);
  return flagged(flags);
}

std::vector<Index> in_map(const Node& node, const SceneBody& body) {
  node.check_keys({"map", "above", "below"});
  if (!node.has("above") && !node.has("below"))
    node.fail("neither 'above' nor 'below' is there; give one of them, or both");
  Real above = -std::numeric_limits<Real>::infinity();
  Real below = std::numeric_limits<Real>::infinity();
  read_optional(node, "above", above);
  read_optional(node, "below", below);
  const std::vector<Real> values = read_map(node.require("map"), body.mesh);
  std::vector<char> flags;
  for (const Real value : values) flags.push_back(value > above && value < below);
  return flagged(flags);
}

std::vector<Index> choose(const Node& node, const SceneBody& body);

/// How many of the selections of a list have each vertex.
std::vector<std::size_t> counts(const Node& list, const SceneBody& body) {
  list.require_list();
  if (list.empty()) list.fail("the list is empty; give selections");
  std::vector<std::size_t> counts(static_cast<std::size_t>(body.mesh.vertex_count()), 0);
  std::vector<std::size_t> last(counts.size(), 0);  // the selection that counted it last, from 1: none counts twice
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (const Index vertex : choose(list[i], body)) {
      const auto v = static_cast<std::size_t>(vertex);
      counts[v] += last[v] == i + 1 ? 0 : 1;
      last[v] = i + 1;
    }
  }
  return counts;
}

std::vector<Index> counted(const std::vector<std::size_t>& counts, std::size_t wanted) {
  std::vector<char> flags;
  for (const std::size_t count : counts) flags.push_back(count >= wanted);
  return flagged(flags);
}

std::vector<Index> any_of(const Node& node, const SceneBody& body) {
  return counted(counts(node, body), 1);
}

std::vector<Index> all_of(const Node& node, const SceneBody& body) {
  return counted(counts(node, body), node.size());
}

std::vector<Index> none_of(const Node& node, const SceneBody& body) {
  std::vector<char> flags(static_cast<std::size_t>(body.mesh.vertex_count()), 1);
  for (const Index vertex : choose(node, body)) flags[static_cast<std::size_t>(vertex)] = 0;
  return flagged(flags);
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
constexpr std::array by_place = {
    ByPlace{"box", in_box},      ByPlace{"half_space", in_half_space},
    ByPlace{"nearest", nearest}, ByPlace{"boundary_loop", in_boundary_loop},
    ByPlace{"group", in_group},  ByPlace{"any_of", any_of},
    ByPlace{"all_of", all_of},   ByPlace{"not", none_of},
};

std::vector<Index> named(const Node& node, const SceneBody& body) {
  std::string name;
  read(node, name);
  const auto found = std::ranges::find(by_name, std::string_view(name), &ByName::name);
  if (found == by_name.end()) {
    node.fail(fmt::format("unknown selection '{}'; {}, or give a list of vertices, {{\"box\": ...}}, ...",
                          printable(name), suggestion_text(name, {"all", "boundary", "corners"})));
  }
  return found->choose(body);
}

std::vector<Index> placed(const Node& node, const SceneBody& body) {
  if (node.has("map")) return in_map(node, body);
  std::vector<std::string_view> keys;
  for (const ByPlace& entry : by_place) keys.push_back(entry.key);
  keys.push_back("map");
  node.check_keys(keys);
  const std::string_view key = node.require_one_of(keys);
  return std::ranges::find(by_place, key, &ByPlace::key)->choose(node.require(key), body);
}

/// The vertices meant, of which there may be none.
std::vector<Index> choose(const Node& node, const SceneBody& body) {
  if (node.is_list()) return read_vertices(node, body.mesh.vertex_count());
  if (node.is_object()) return placed(node, body);
  if (!node.is_text()) node.fail_type("\"all\", a list of vertices, or {\"box\": ...}");
  if (node.text() == "all") return flagged(std::vector<char>(static_cast<std::size_t>(body.mesh.vertex_count()), 1));
  return named(node, body);
}

}  // namespace

Selection read_selection(const Node& node, const SceneBody& body) {
  if (node.is_text() && node.text() == "all") return {};
  std::vector<Index> vertices = choose(node, body);
  if (vertices.empty()) {
    const BoundingBox box = bounding_box(body.mesh.vertices);
    node.fail(fmt::format("no vertex is selected; the body spans ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g})", box.min[0],
                          box.min[1], box.min[2], box.max[0], box.max[1], box.max[2]));
  }
  return vertices;
}

}  // namespace pliant
