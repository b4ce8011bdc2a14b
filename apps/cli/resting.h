#pragma once
// Whether colliders catch what no constraint holds.
#include <span>

#include "pliant/simulation/simulation.h"

namespace pliant_cli {

/// Whether gravity brings one of these vertices to a collider, all being where they are now: a plane that it falls
/// onto, or any other collider straight below it. False where there is no gravity.
bool falls_onto_collider(const pliant::Simulation& simulation, std::span<const pliant::Index> vertices);

}  // namespace pliant_cli
