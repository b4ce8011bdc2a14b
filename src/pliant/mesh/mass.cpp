#include "pliant/mesh/mass.h"

#include <cmath>
#include <numeric>
#include <string>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/mesh/geometry.h"

namespace pliant {

namespace {

bool is_positive(Real value) {
  return std::isfinite(value) && value > 0;
}

/// Gives each vertex its equal part of the measures of its elements.
template <typename Element>
std::vector<Real> lump(Index vertex_count, const std::vector<Element>& elements, const std::vector<Real>& measures) {
  std::vector<Real> lumped(static_cast<std::size_t>(vertex_count), 0);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const Real part = measures[e] / static_cast<Real>(elements[e].size());
    for (Index vertex : elements[e]) lumped[static_cast<std::size_t>(vertex)] += part;
  }
  return lumped;
}

std::vector<Real> lumped_lengths(const Mesh& mesh) {
  return lump(mesh.vertex_count(), mesh.edges, edge_lengths(mesh.vertices, mesh.edges));
}

std::vector<Real> lumped_volumes(const Mesh& mesh) {
  if (!mesh.embedding.is_empty()) return mesh.embedding.volumes;
  return lump(mesh.vertex_count(), mesh.tetrahedra, tetrahedron_volumes(mesh.vertices, mesh.tetrahedra));
}

/// Shares that sum to 1.
std::vector<Real> shares(const Mesh& mesh) {
  std::vector<Real> measures(static_cast<std::size_t>(mesh.vertex_count()), 1);
  if (!mesh.tetrahedra.empty()) {
    measures = lumped_volumes(mesh);
  } else if (!mesh.triangles.empty()) {
    measures = vertex_areas(mesh.vertices, mesh.triangles);
  } else if (!mesh.edges.empty()) {
    measures = lumped_lengths(mesh);
  }
  const Real sum = std::accumulate(measures.begin(), measures.end(), Real{0});
  for (Real& measure : measures) measure /= sum;
  return measures;
}

std::vector<Real> scaled(std::vector<Real> values, Real factor) {
  for (Real& value : values) value *= factor;
  return values;
}

void require_elements(bool has_elements, std::string_view what, std::string_view elements, std::string_view name) {
  if (has_elements) return;
  fail_input(fmt::format("{}: the mass is given as {}, but the mesh has no {}; give the total mass or one per vertex",
                         name, what, elements));
}

void check_values(const Mesh& mesh, const Mass::Part& mass, std::string_view name) {
  if (mass.kind != Mass::Kind::each) {
    const Real value = mass.values.front();
    if (!is_positive(value))
      fail_input(fmt::format("{}: the mass is {}; give one that is finite and above 0", name, value));
    return;
  }
  if (mass.values.size() != static_cast<std::size_t>(mesh.vertex_count())) {
    fail_input(fmt::format("{}: there are {} masses for {} vertices; give one for each vertex", name,
                           mass.values.size(), mesh.vertex_count()));
  }
}

std::vector<Real> distribute(const Mesh& mesh, const Mass::Part& mass, std::string_view name) {
  const Real value = mass.kind == Mass::Kind::each ? 0 : mass.values.front();
  switch (mass.kind) {
    case Mass::Kind::per_vertex:
      return std::vector<Real>(static_cast<std::size_t>(mesh.vertex_count()), value);
    case Mass::Kind::total:
      return scaled(shares(mesh), value);
    case Mass::Kind::area_density:
      require_elements(!mesh.triangles.empty(), "an area density", "triangles", name);
      return scaled(vertex_areas(mesh.vertices, mesh.triangles), value);
    case Mass::Kind::density:
      require_elements(!mesh.tetrahedra.empty(), "a density", "tetrahedra", name);
      return scaled(lumped_volumes(mesh), value);
    case Mass::Kind::line_density:
      require_elements(!mesh.edges.empty(), "a line density", "edge elements", name);
      return scaled(lumped_lengths(mesh), value);
    case Mass::Kind::each:
      break;
  }
  return mass.values;
}

}  // namespace

std::vector<Real> vertex_masses(const Mesh& mesh, const Mass& mass, std::string_view name) {
  std::vector<Real> masses(static_cast<std::size_t>(mesh.vertex_count()), 0);
  bool is_given = false;
  for (const Mass::Part& part : mass.parts()) {
    check_values(mesh, part, name);
    const std::vector<Real> more = distribute(mesh, part, name);
    for (std::size_t v = 0; v < masses.size(); ++v) masses[v] += more[v];
    is_given = is_given || part.kind == Mass::Kind::each || part.kind == Mass::Kind::per_vertex;
  }
  for (std::size_t v = 0; v < masses.size(); ++v) {
    if (is_positive(masses[v])) continue;
    fail_input(fmt::format("{}: vertex {} has mass {}; {}", name, v, masses[v],
                           is_given || masses[v] != 0
                               ? "give every vertex one that is finite and above 0"
                               : "no element gives it any: remove the vertex, or give one mass per vertex"));
  }
  return masses;
}

}  // namespace pliant
