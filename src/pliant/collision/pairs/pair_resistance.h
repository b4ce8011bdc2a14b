#pragma once
// What pairs do to components that move as rigid bodies.
#include "pliant/collision/contact/rigid_couplings.h"
#include "pliant/collision/pairs/near_pair.h"

namespace pliant {

/// Adds the vertices of pairs between two components that may push each other, and those components.
void add_touching(std::span<const NearPair> pairs, std::span<const Index> component_of_vertex,
                  std::vector<Index>& vertices, RigidCouplings& couplings);

/// Adds what pairs between two components do with those vertices at q, of which others are not asked: forces on each,
/// what they resist rigid motions of each with, as if the other one stood still, and of both together besides, and the
/// energy of each pair to one of its components. begin: positions at the beginning of the substep.
void add_resistance(std::span<const NearPair> pairs, const Positions& q, const Positions& begin,
                    std::span<const Index> component_of_vertex, std::span<RigidResistance> components,
                    RigidCouplings& couplings);

/// Adds the energy of each pair to the same one of its components [J].
void add_energies(std::span<const NearPair> pairs, std::span<const Index> component_of_vertex,
                  std::span<Real> components);

/// The same without what friction takes away: what the pairs may give back.
void add_stored_energies(std::span<const NearPair> pairs, std::span<const Index> component_of_vertex,
                         std::span<Real> components);

/// The potential of those that are pressed below r/2, into its logarithm [J].
Real steep_energy(std::span<const NearPair> pairs);

/// Of each component the least of those that it can come to touch, directly or by way of others. `least` begins with
/// every component's own number.
void join_components(std::span<const NearPair> pairs, std::span<const Index> component_of_vertex,
                     std::span<std::size_t> least);
/// The same of those that push or soon may, also marked, and of the two of such a pair alone; see flatten().
void join_touching(std::span<const NearPair> pairs, std::span<const Index> component_of_vertex,
                   std::span<std::size_t> least, std::span<char> touches);
void join(std::size_t a, std::size_t b, std::span<std::size_t> least);
/// Makes every number that join() has left the least one.
void flatten(std::span<std::size_t> least);

}  // namespace pliant
