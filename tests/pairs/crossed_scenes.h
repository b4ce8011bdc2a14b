#pragma once
// Scenes that begin with crossings, or in which pinned surfaces are driven through others.
#include "tests/pairs/pair_scene.h"

namespace pliant_tests {

/// A sheet of 1 × 1 m in the plane z = 0 and, through its middle, an upright one of 0.6 × 0.6 m, which moves upward
/// with a speed [m/s]. No gravity.
PairScene crossed_sheets(const PairOptions& options, pliant::Real speed);

/// The same, but pins at the upper border of the upright sheet pull it upward with a speed [m/s], and the other one is
/// pinned all over. With gravity.
PairScene pulled_apart(const PairOptions& options, pliant::Real speed);

/// A rope hangs through a pinned sheet and falls.
PairScene rope_through_sheet(const PairOptions& options);

/// A strip that is bent to a loop, so that its ends cross, falls on a floor.
PairScene crossed_loop(const PairOptions& options);

/// Soft boxes, sheets and ropes, placed by chance where they cross each other, fall on a floor.
PairScene crossed_pile(const PairOptions& options);

/// Sheets of 1 × 1 m and 0.8 × 0.8 m, a share of the contact distance apart. The lower one is pinned or not, with
/// gravity or without.
PairScene near_sheets(const PairOptions& options, pliant::Real share, bool is_pinned);

/// Two sheets that are pinned all over come together with a speed [m/s], through each other and on to 0.15 m beyond; a
/// free one of half their size is between them.
PairScene closing_sheets(const PairOptions& options, pliant::Real speed);

/// A sheet that is pinned in its middle, and an upright one whose lower half is pinned and goes down through it with
/// 1 m/s, for half a second, and up again.
PairScene driven_through(const PairOptions& options);

}  // namespace pliant_tests
