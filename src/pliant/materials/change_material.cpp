#include "pliant/materials/change_material.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "pliant/constraints/hyperelastic.h"
#include "pliant/core/printable.h"
#include "pliant/mesh/loose.h"
#include "pliant/simulation/carried_surface.h"
#include "pliant/simulation/transaction.h"

namespace pliant {
namespace {

using Elastic = std::tuple<EdgeSpring, EdgeStrain, FibreStrain, TriangleStrain, TriangleArea, Bending, HingeBending,
                           TriangleBending, TetrahedronStrain, TetrahedronVolume, TriangleNeoHookean, TriangleStvk,
                           TetrahedronNeoHookean, TetrahedronStvk>;

/// Whether a group has all elements of its body, by options of this type.
template <class Constraint>
bool is_whole(const Group& group) {
  const auto* options = options_in<Constraint>(group);
  return options != nullptr && options->on.everything && options->stencils.empty();
}

template <class... Types>
bool is_elastic(std::tuple<Types...>*, const Group& group) {
  return (is_whole<Types>(group) || ...);
}

/// Of the material, and of vertices without an element what they have.
void weigh(Simulation& simulation, BodyId id, const Material& material) {
  const Body& body = simulation.body(id);
  const std::vector<Index> loose = loose_vertices(body.mesh);
  if (loose.empty()) return simulation.set_mass(id, mass_of(material));
  const auto first = simulation.state().masses.begin() + body.first_vertex;
  const std::vector<Real> before(first, first + body.mesh.vertex_count());
  std::vector<Real> masses = vertex_masses(body.mesh, mass_of(material) + Mass::each(before), body.name);
  for (std::size_t i = 0; i < masses.size(); ++i) {
    if (!std::ranges::binary_search(loose, static_cast<Index>(i))) masses[i] -= before[i];
  }
  simulation.set_mass(id, Mass::each(std::move(masses)));
}

/// Ties of a surface that a lattice carries stay as many times stiffer than the body.
void stiffen_ties(Simulation& simulation, BodyId id, Real before) {
  const Real now = tetrahedron_stiffness(simulation, id);
  if (simulation.body(id).mesh.embedding.is_empty() || !(before > 0) || !(now > 0)) return;
  std::vector<GroupId> ties;
  for (const auto& [group_id, group] : simulation.groups()) {
    if (group.body == id && group.type == Attachment::info.name && !group.other) ties.push_back(group_id);
  }
  for (const GroupId tie : ties) {
    if (const auto stiffness = simulation.stiffness(tie)) simulation.set_stiffness(tie, *stiffness * now / before);
  }
}

/// As material_groups() was told it, to the last digit where it is a short number.
Real slack_of(const FibreStrain& fibres) {
  if (fibres.slack_factor == 1) return 0;
  constexpr Real digits = 1e12, most = 0.1;
  return std::clamp<Real>(std::round(digits * (fibres.taut_stretch - 1) / 2) / digits, 0, most);
}

}  // namespace

bool goes_with_material(const Group& group) {
  return is_elastic(static_cast<Elastic*>(nullptr), group);
}

std::vector<GroupId> groups_of_material(const Simulation& simulation, BodyId id) {
  std::vector<GroupId> found;
  for (const auto& [group_id, group] : simulation.groups()) {
    if (group.body == id && goes_with_material(group)) found.push_back(group_id);
  }
  return found;
}

MaterialPlacement present_placement(const Simulation& simulation, BodyId id) {
  for (const auto& [group_id, group] : simulation.groups()) {
    if (group.body != id) continue;
    if (const auto* fibres = options_in<FibreStrain>(group)) {
      return {
          .direction = fibres->direction, .grain = fibres->grain, .angle = fibres->angle, .slack = slack_of(*fibres)};
    }
  }
  return {};
}

std::vector<GroupId> change_material(Simulation& simulation, BodyId id, const Material& material,
                                     const std::optional<MaterialPlacement>& placement) {
  check_material(simulation.body(id), material);
  Transaction transaction(simulation);
  const Real stiffness = tetrahedron_stiffness(simulation, id);
  const std::string body = simulation.body(id).name;
  std::vector<MaterialGroup> wanted =
      material_groups(material, placement ? *placement : present_placement(simulation, id));
  std::vector<GroupId> made;
  for (const GroupId old : groups_of_material(simulation, id)) {
    const auto same = std::ranges::find_if(wanted, [&](const MaterialGroup& group) {
      return simulation.groups().at(old).name == fmt::format("{}.{}", body, group.name);
    });
    if (same == wanted.end()) {
      simulation.remove(old);
      continue;
    }
    std::visit([&](const auto& options) { simulation.replace(old, options); }, same->options);
    made.push_back(old);
    wanted.erase(same);
  }
  for (const MaterialGroup& group : wanted) {
    const std::string name = fmt::format("{}.{}", body, group.name);
    made.push_back(std::visit([&](const auto& options) { return simulation.add(id, options, name); }, group.options));
  }
  weigh(simulation, id, material);
  BodyContact contact = simulation.body(id).contact;
  contact.friction = material.surface.friction;
  simulation.set_contact(id, contact);
  stiffen_ties(simulation, id, stiffness);
  transaction.commit();
  return made;
}

}  // namespace pliant
