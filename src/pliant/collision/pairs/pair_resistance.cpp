#include "pliant/collision/pairs/pair_resistance.h"

#include <algorithm>

namespace pliant {
namespace {

/// Of r: pairs that are farther apart are not asked.
constexpr Real pushing_reach = 1.25;

struct ComponentPair {
  std::size_t first, second;
};

ComponentPair components_of(const Pair& pair, std::span<const Index> component_of_vertex) {
  const auto second = static_cast<std::size_t>(pair.first_side());
  return {at(component_of_vertex[at(pair.vertices[0])]), at(component_of_vertex[at(pair.vertices[second])])};
}

/// Calls visit(pair, its components) for those that may push each other after a short motion.
template <class Visit>
void visit_pushing(std::span<const NearPair> pairs, std::span<const Index> component_of_vertex, Visit&& visit) {
  for (const NearPair& each : pairs) {
    const ComponentPair components = components_of(each.pair, component_of_vertex);
    if (components.first == components.second) continue;
    if (each.load > 0 || each.gap.distance < pushing_reach * each.radius) visit(each, components);
  }
}

std::size_t least_of(std::span<std::size_t> least, std::size_t component) {
  while (least[component] != component) component = least[component] = least[least[component]];
  return component;
}

}  // namespace

void add_touching(std::span<const NearPair> pairs, std::span<const Index> component_of_vertex,
                  std::vector<Index>& vertices) {
  visit_pushing(pairs, component_of_vertex, [&](const NearPair& each, const ComponentPair&) {
    vertices.insert(vertices.end(), each.pair.vertices.begin(), each.pair.vertices.end());
  });
}

void add_resistance(std::span<const NearPair> pairs, const Positions& q, const Positions& begin,
                    std::span<const Index> component_of_vertex, std::span<RigidResistance> components) {
  visit_pushing(pairs, component_of_vertex, [&](const NearPair& known, const ComponentPair& of_pair) {
    NearPair each = known;
    each.look(q, begin);
    if (!each.is_active()) return;
    components[of_pair.first].energy += each.energy();
    const auto first_side = static_cast<std::size_t>(each.pair.first_side());
    Vec3 place = Vec3::Zero();
    for (std::size_t j = 0; j < 4; ++j) {
      const Vec3 x = row(q, each.pair.vertices[j]);
      if (j < first_side) place += each.gap.weights[j] * x;
      components[j < first_side ? of_pair.first : of_pair.second].add_force(x, each.force_on(j));
    }
    Mat3 stiffness = each.pushed.curvature * each.gap.normal * each.gap.normal.transpose() -
                     each.rubbed.curvature * each.friction_normal * each.friction_normal.transpose();
    stiffness.diagonal().array() += each.rubbed.curvature;
    components[of_pair.first].add_stiffness(place, stiffness);
    components[of_pair.second].add_stiffness(place, stiffness);
  });
}

void add_energies(std::span<const NearPair> pairs, std::span<const Index> component_of_vertex,
                  std::span<Real> components) {
  for (const NearPair& each : pairs) {
    if (each.is_active()) components[components_of(each.pair, component_of_vertex).first] += each.energy();
  }
}

void add_stored_energies(std::span<const NearPair> pairs, std::span<const Index> component_of_vertex,
                         std::span<Real> components) {
  for (const NearPair& each : pairs) {
    if (!each.is_active()) continue;
    components[components_of(each.pair, component_of_vertex).first] += each.stored_energy();
  }
}

Real steep_energy(std::span<const NearPair> pairs) {
  Real energy = 0;
  for (const NearPair& each : pairs) {
    if (each.pushed.force > 0 && each.gap.distance < each.radius / 2) energy += each.pushed.energy;
  }
  return energy;
}

void join(std::size_t a, std::size_t b, std::span<std::size_t> least) {
  const std::size_t first = least_of(least, a);
  const std::size_t second = least_of(least, b);
  least[std::max(first, second)] = std::min(first, second);
}

void flatten(std::span<std::size_t> least) {
  for (std::size_t i = 0; i < least.size(); ++i) least[i] = least_of(least, i);
}

void join_components(std::span<const NearPair> pairs, std::span<const Index> component_of_vertex,
                     std::span<std::size_t> least) {
  for (const NearPair& each : pairs) {
    const auto [a, b] = components_of(each.pair, component_of_vertex);
    join(a, b, least);
  }
  flatten(least);
}

void join_touching(std::span<const NearPair> pairs, std::span<const Index> component_of_vertex,
                   std::span<std::size_t> least, std::span<char> touches) {
  for (const NearPair& each : pairs) {
    if (!(each.load > 0) && !(each.gap.distance < pushing_reach * each.radius)) continue;
    const auto [a, b] = components_of(each.pair, component_of_vertex);
    join(a, b, least);
    touches[a] = touches[b] = 1;
  }
}

}  // namespace pliant
