#include "pliant_io/scene/detail/read_solid.h"

#include <algorithm>

#include <fmt/format.h>

#include "pliant/core/printable.h"
#include "pliant/mesh/geometry.h"
#include "pliant/mesh/lattice.h"
#include "pliant/mesh/nearest_vertex.h"
#include "pliant/mesh/topology.h"
#include "pliant_io/scene/detail/option_reader.h"

namespace pliant {
namespace {

/// Edges of a surface longer than that many spacings are worth a word.
constexpr Real long_edge = 2.5;

void check_mass_of_solid(const Node& body) {
  const auto mass = body.find("mass");
  if (!mass || !mass->is_object()) return;
  for (const char* key : {"per_vertex", "each", "line_density"}) {
    if (const auto given = mass->find(key)) {
      given->fail("a solid made from its surface has vertices that the surface has not; give its 'density' or 'total'");
    }
  }
  if (mass->has("area_density") && !mass->has("density")) {
    mass->require("area_density").fail("that is of the surface alone; give its 'density' besides, or its 'total'");
  }
}

}  // namespace

void read_solid(const Node& node, const Node& body, const std::string& name, Mesh& mesh,
                std::vector<std::string>& warnings) {
  if (body.has("animation")) {
    node.fail("an animated body goes where it is told, and needs no inside; leave out 'solid' or 'animation'");
  }
  LatticeOptions options;
  read_options(node, options);
  node.require("spacing");
  check_mass_of_solid(body);
  const std::vector<Triangle> before = mesh.triangles;
  node.locate([&] { mesh = lattice_solid(std::move(mesh), options, printable(name)); });
  Index turned = 0;
  for (std::size_t t = 0; t < before.size(); ++t) turned += before[t] == mesh.triangles[t] ? 0 : 1;
  if (turned > 0) {
    warnings.push_back(node.at(
        fmt::format("{} of {} triangles were turned, so that all normals point outward", turned, before.size())));
  }
  Real longest = 0;
  for (const Real length : edge_lengths(mesh.vertices, edge_triangles(mesh).edges)) longest = std::max(longest, length);
  if (longest > long_edge * options.spacing) {
    warnings.push_back(node.at(
        fmt::format("the surface has edges of {:.3g} m, longer than the spacing of {:.3g} m: it bends and touches at "
                    "its own vertices only; give a finer surface",
                    longest, options.spacing)));
  }
}

Positions completed_rows(const Mesh& mesh, Positions rows, const Positions& rest) {
  const Index count = mesh.embedding.carried_count();
  if (mesh.embedding.is_empty() || rows.rows() != count) return rows;
  const NearestVertex nearest(mesh.vertices.topRows(count));
  rows.conservativeResize(mesh.vertex_count(), 3);
  for (Index v = count; v < mesh.vertex_count(); ++v) {
    const Index found = nearest(row(mesh.vertices, v));
    rows.row(v) = rest.row(v) + rows.row(found) - rest.row(found);
  }
  return rows;
}

}  // namespace pliant
