#pragma once
// What a run leaves behind, to the last bit.
#include <vector>

#include "tests/pairs/pair_scene.h"

namespace pliant_tests {

/// The objective after each iteration of the last step, and all positions and velocities.
std::vector<pliant::Real> bits_of(const pliant::Simulation& simulation);
bool same_bits(const std::vector<pliant::Real>& a, const std::vector<pliant::Real>& b);

}  // namespace pliant_tests
