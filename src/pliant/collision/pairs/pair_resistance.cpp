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

Mat3 stiffness_of(const NearPair& pair, SlidingFriction sliding) {
  Mat3 stiffness = pair.pushed.curvature * pair.gap.normal * pair.gap.normal.transpose() -
                   pair.rubbed.curvature * pair.friction_normal * pair.friction_normal.transpose();
  stiffness.diagonal().array() += pair.rubbed.curvature;
  const bool slides = pair.rubbed.curvature < pair.weight * pair.stiffness;
  if (slides && sliding == SlidingFriction::as_it_is) {
    const Vec3 along = pair.rubbed.force.normalized();
    stiffness -= pair.rubbed.curvature * along * along.transpose();
  }
  return stiffness;
}

std::size_t least_of(std::span<std::size_t> least, std::size_t component) {
  while (least[component] != component) component = least[component] = least[least[component]];
  return component;
}

}  // namespace

void add_touching(std::span<const NearPair> pairs, std::span<const Index> component_of_vertex,
                  std::vector<Index>& vertices, RigidCouplings& couplings) {
  visit_pushing(pairs, component_of_vertex, [&](const NearPair& each, const ComponentPair& of_pair) {
    couplings.add(of_pair.first, of_pair.second);
    vertices.insert(vertices.end(), each.pair.vertices.begin(), each.pair.vertices.end());
  });
}

void add_resistance(std::span<const NearPair> pairs, const Positions& q, const Positions& begin,
                    std::span<const Index> component_of_vertex, std::span<RigidResistance> components,
                    RigidCouplings& couplings) {
  visit_pushing(pairs, component_of_vertex, [&](const NearPair& known, const ComponentPair& of_pair) {
    NearPair each = known;
    each.look(q, begin);
    if (!each.is_active()) return;
    RigidResistance& first = components[of_pair.first];
    RigidResistance& second = components[of_pair.second];
    first.energy += each.energy();
    const auto first_side = static_cast<std::size_t>(each.pair.first_side());
    Vec3 place = Vec3::Zero();
    Vec3 place_of_second = Vec3::Zero();
    for (std::size_t j = 0; j < 4; ++j) {
      const Vec3 x = row(q, each.pair.vertices[j]);
      if (j < first_side) {
        place += each.gap.weights[j] * x;
      } else {
        place_of_second -= each.gap.weights[j] * x;
      }
      (j < first_side ? first : second).add_force(x, each.force_on(j));
    }
    const bool is_bounded = first.sliding == SlidingFriction::bounded || second.sliding == SlidingFriction::bounded;
    const Mat3 stiffness = stiffness_of(each, is_bounded ? SlidingFriction::bounded : SlidingFriction::as_it_is);
    first.add_stiffness(place, stiffness);
    second.add_stiffness(place_of_second, stiffness);
    couplings.add_stiffness(of_pair.first, of_pair.second, place - first.center, place_of_second - second.center,
                            stiffness);
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
