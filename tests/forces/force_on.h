#pragma once
// A force on one body alone, without a simulation.
#include "pliant/forces/force_options.h"

namespace pliant_tests {

/// The first vertex of the mesh has the number `first_vertex`.
template <class Options>
std::unique_ptr<pliant::Force> force_on(const pliant::Mesh& mesh, const Options& options,
                                        pliant::Index first_vertex = 0) {
  return build(pliant::ForceScope{.bodies = {{mesh, first_vertex, "body"}}}, options);
}

}  // namespace pliant_tests
