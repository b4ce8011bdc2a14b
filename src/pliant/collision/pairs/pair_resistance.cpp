#include "pliant/collision/pairs/pair_resistance.h"

#include <algorithm>

namespace pliant {
namespace {

struct ComponentPair {
  std::size_t first, second;
};

ComponentPair components_of(const Pair& pair, std::span<const Index> component_of_vertex) {
  const auto second = static_cast<std::size_t>(pair.first_side());
  return {at(component_of_vertex[at(pair.vertices[0])]), at(component_of_vertex[at(pair.vertices[second])])};
}

std::size_t least_of(std::span<std::size_t> least, std::size_t component) {
  while (least[component] != component) component = least[component] = least[least[component]];
  return component;
}

}  // namespace

void add_resistance(std::span<const NearPair> pairs, const Positions& q, std::span<const Index> component_of_vertex,
                    std::span<RigidResistance> components) {
  for (const NearPair& each : pairs) {
    if (!each.is_active()) continue;
    const auto [a, b] = components_of(each.pair, component_of_vertex);
    components[a].energy += each.energy();
    if (a == b) continue;
    Vec3 place = Vec3::Zero();
    for (std::size_t j = 0; j < static_cast<std::size_t>(each.pair.first_side()); ++j) {
      place += each.gap.weights[j] * row(q, each.pair.vertices[j]);
    }
    for (const std::size_t component : {a, b}) {
      RigidResistance& sum = components[component];
      sum.add_spring(place, each.gap.normal, each.pushed.curvature);
      const Vec3 along = each.friction_normal.unitOrthogonal();
      sum.add_spring(place, along, each.rubbed.curvature);
      sum.add_spring(place, each.friction_normal.cross(along), each.rubbed.curvature);
    }
  }
}

void add_energies(std::span<const NearPair> pairs, std::span<const Index> component_of_vertex,
                  std::span<Real> components) {
  for (const NearPair& each : pairs) {
    if (each.is_active()) components[components_of(each.pair, component_of_vertex).first] += each.energy();
  }
}

void join_components(std::span<const NearPair> pairs, std::span<const Index> component_of_vertex,
                     std::span<std::size_t> least) {
  for (const NearPair& each : pairs) {
    const auto [a, b] = components_of(each.pair, component_of_vertex);
    const std::size_t first = least_of(least, a);
    const std::size_t second = least_of(least, b);
    least[std::max(first, second)] = std::min(first, second);
  }
  for (std::size_t i = 0; i < least.size(); ++i) least[i] = least_of(least, i);
}

}  // namespace pliant
