#pragma once
// Whether something catches what no constraint holds.
#include <span>

#include "pliant/simulation/simulation.h"

namespace pliant_cli {

/// Whether gravity brings one of these vertices to a collider, all being where they are now: a plane that it falls
/// onto, or any other collider straight below it; or, where surfaces touch, to a triangle straight below it whose
/// vertices are pinned. Of many vertices some are asked about triangles. False where there is no gravity.
bool is_caught(const pliant::Simulation& simulation, std::span<const pliant::Index> vertices);

}  // namespace pliant_cli
