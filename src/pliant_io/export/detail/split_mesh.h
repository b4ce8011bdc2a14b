#pragma once
// A mesh cut into the bodies that it was put together from (one_mesh.h).
#include "pliant/simulation/simulation.h"
#include "pliant_io/recorder/detail/run_json.h"

namespace pliant {

/// The bodies with their own parts of the mesh; a single body has all of it, however it is grouped. `name` is what
/// messages call the mesh.
/// @throws Error (input): other vertices than the bodies', an element between two bodies.
std::vector<Body> split_mesh(const Mesh& mesh, const std::vector<BodyRange>& bodies, const std::string& name);

}  // namespace pliant
