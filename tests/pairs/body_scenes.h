#pragma once
// Soft bodies and ropes that meet sheets and each other.
#include "tests/pairs/pair_scene.h"

namespace pliant_tests {

/// A rubber block of 8.8 kg falls onto a sheet of 72 g whose border is pinned, just above a floor.
PairScene block(const PairOptions& options);

/// A rope, wound to a coil of three turns, falls onto a sheet that is pinned at its border.
PairScene rope(const PairOptions& options);

/// A rope that stands almost upright falls onto a floor and onto itself.
PairScene coil(const PairOptions& options);

/// Soft boxes and balls, drawn by chance and turned, fall towards the middle of a floor and into each other.
PairScene pile(const PairOptions& options);
PairScene pile(const PairOptions& options, pliant::Index bodies, pliant::Index cells);

/// Two soft boxes fly at each other without gravity, askew and off center, with 1 m/s each.
PairScene collision_of_two(const PairOptions& options);

}  // namespace pliant_tests
