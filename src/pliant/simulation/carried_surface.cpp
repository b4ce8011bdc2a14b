#include "pliant/simulation/carried_surface.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "pliant/constraints/attachment.h"
#include "pliant/constraints/hyperelastic.h"
#include "pliant/constraints/tetrahedron_strain.h"
#include "pliant/constraints/tetrahedron_volume.h"
#include "pliant/core/error.h"
#include "pliant/mesh/geometry.h"

namespace pliant {
namespace {

/// The largest stiffness that options of that type give, with the factor of now; 0 of others.
template <class Constraint>
Real largest_stiffness(const Group& group, std::optional<Real> factor) {
  const std::optional<Constraint> options = options_of<Constraint>(group, factor);
  if (!options) return 0;
  Real largest = 0;
  for (const Real value : options->stiffness.list()) largest = std::max(largest, value);
  return largest;
}

/// The vertex, then the corners of its tetrahedron.
std::array<Index, 5> tie_stencil(const Mesh& mesh, Index v) {
  std::array<Index, 5> stencil = {v};
  std::ranges::copy(mesh.tetrahedra[at(mesh.embedding.tetrahedra[at(v)])], stencil.begin() + 1);
  return stencil;
}

}  // namespace

Real tetrahedron_stiffness(const Simulation& simulation, BodyId id) {
  Real sum = 0;
  for (const auto& [group_id, group] : simulation.groups()) {
    if (group.body != id) continue;
    const std::optional<Real> factor = simulation.stiffness(group_id);
    sum += largest_stiffness<TetrahedronStrain>(group, factor) + largest_stiffness<TetrahedronVolume>(group, factor);
    sum += largest_stiffness<TetrahedronNeoHookean>(group, factor) + largest_stiffness<TetrahedronStvk>(group, factor);
  }
  return sum;
}

GroupId carry_surface(Simulation& simulation, BodyId id, Real stiffness, std::string name) {
  const Body& body = simulation.body(id);
  const Mesh& mesh = body.mesh;
  if (mesh.embedding.is_empty()) {
    fail_input(fmt::format("body '{}' carries no surface; make its mesh by lattice_solid", body.name));
  }
  if (!(stiffness >= 0) || !std::isfinite(stiffness)) {
    fail_input(
        fmt::format("body '{}': ties have stiffness {}; give one that is finite and above 0, or 0 for {} times "
                    "that of the body",
                    body.name, stiffness, tie_ratio));
  }
  if (stiffness == 0) stiffness = tie_ratio * tetrahedron_stiffness(simulation, id);
  if (stiffness == 0) stiffness = usual_tie_stiffness;
  const std::vector<Real> areas = vertex_areas(mesh.vertices, mesh.triangles);
  auto batch = std::make_unique<Batch<AttachmentProjection>>(stiffness, 5);
  const std::array<Real, 5> joined{};  // L = 0
  for (Index v = 0; v < mesh.embedding.carried_count(); ++v) {
    std::array<Index, 5> stencil = tie_stencil(mesh, v);
    for (Index& vertex : stencil) vertex += body.first_vertex;
    std::array<Real, 5> reduction = {1};
    for (std::size_t i = 0; i < 4; ++i) reduction[i + 1] = -mesh.embedding.weights[at(v)][i];
    batch->add(stencil, reduction, areas[at(v)] / mesh.embedding.spacing, joined);
  }
  ConstraintSet set;
  set.count = mesh.embedding.carried_count();
  set.batches.push_back(std::move(batch));
  if (name.empty()) name = body.name + ".surface";
  return simulation.add_set(id, std::move(set), std::string(Attachment::info.name), std::move(name));
}

Real largest_departure(const Simulation& simulation, BodyId id) {
  const Body& body = simulation.body(id);
  const Positions& x = simulation.state().positions;
  Real largest = 0;
  for (Index v = 0; v < body.mesh.embedding.carried_count(); ++v) {
    const std::array<Index, 5> stencil = tie_stencil(body.mesh, v);
    Vec3 apart = row(x, body.first_vertex + v);
    for (std::size_t i = 0; i < 4; ++i) {
      apart -= body.mesh.embedding.weights[at(v)][i] * row(x, body.first_vertex + stencil[i + 1]);
    }
    largest = std::max(largest, apart.norm());
  }
  return largest;
}

}  // namespace pliant
