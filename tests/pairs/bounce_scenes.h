#pragma once
// What falls with 2 m/s, or faster, and bounces.
#include "tests/pairs/pair_scene.h"

namespace pliant_tests {

/// A rubber block on one whose bottom is pinned.
PairScene bounce_block(const PairOptions& options);

/// A sheet of 0.3 × 0.3 m on one of 0.6 × 0.6 m whose border is pinned.
PairScene bounce_sheet(const PairOptions& options);

/// A rubber ball of 0.2 m on the same sheet.
PairScene bounce_ball(const PairOptions& options);

}  // namespace pliant_tests
