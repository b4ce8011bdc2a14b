#pragma once
// What pairs do to components that move as rigid bodies.
#include "pliant/collision/contact/rigid_resistance.h"
#include "pliant/collision/pairs/near_pair.h"

namespace pliant {

/// Adds what pairs between two components resist rigid motions of each with, as if the other one stood still, and the
/// energy of each pair to one of its components.
void add_resistance(std::span<const NearPair> pairs, const Positions& q, std::span<const Index> component_of_vertex,
                    std::span<RigidResistance> components);

/// Adds the energy of each pair to the same one of its components [J].
void add_energies(std::span<const NearPair> pairs, std::span<const Index> component_of_vertex,
                  std::span<Real> components);

/// Of each component the least of those that it can come to touch, directly or by way of others. `least` begins with
/// every component's own number.
void join_components(std::span<const NearPair> pairs, std::span<const Index> component_of_vertex,
                     std::span<std::size_t> least);

}  // namespace pliant
