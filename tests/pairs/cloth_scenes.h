#pragma once
// Sheets that meet themselves and each other: 0.2 kg/m², 1000 N/m against strain, 1e-5 N·m against bending.
#include "tests/pairs/pair_scene.h"

namespace pliant_tests {

/// A sheet of 1 × 1 m falls by 5 cm onto a sphere of 0.3 m and hangs down to a floor.
PairScene drape(const PairOptions& options);

/// The same with 5.5 m/s, for one second.
PairScene fall(const PairOptions& options);

/// A sheet on a sphere that after a second begins to turn about the vertical with 3 rad/s.
PairScene rotating_sphere(const PairOptions& options);

/// A strip of 0.4 × 0.8 m, whose pinned ends turn against each other, four times in 8 s, and come nearer.
PairScene twist(const PairOptions& options);

/// An upright strip of 0.5 × 1 m, slightly wavy, falls onto a floor and folds.
PairScene fold(const PairOptions& options);

/// Five sheets of 0.6 × 0.6 m, five bodies, fall onto a sphere of 0.2 m above a floor.
PairScene stack(const PairOptions& options);

/// A sheet of 0.4 × 0.4 m, turned by 0.4 rad, falls onto the middle of a pinned one of 1 × 1 m.
PairScene two_sheets(const PairOptions& options);

/// Sheets of 0.5 × 0.5 m lie on each other and on a plane, all free, a contact distance apart.
struct Layers {
  pliant::Index count = 2;
  pliant::Real shift = 0;         ///< of each against the one below, in edges
  pliant::Real speed_of_top = 0;  ///< along x [m/s]
};
PairScene layers_free(const PairOptions& options, const Layers& layers);
PairScene two_layers_free(const PairOptions& options);  ///< shifted by 0.37 edges, the upper one begins with 1 m/s

/// A sheet slides on a pinned one: body 1 on body 0. Gravity is tilted in place of the sheets, towards x.
struct SlopeScene {
  PairScene scene;
  pliant::Real angle = 0;     ///< [rad]
  pliant::Real friction = 0;  ///< μ

  /// How far the sheet has come on the average, along the slope [m].
  pliant::Real way() const;
  /// What implicit Euler makes of Coulomb's law after so many steps: h² n(n + 1)/2 g (sin θ − μ cos θ), or 0 [m].
  pliant::Real exact_way(pliant::Index steps) const;
};
SlopeScene slope2(const PairOptions& options, pliant::Real degrees);
/// The same of a frame of ropes on two pinned ropes along the slope: edges touch edges, at four places, and nothing
/// else.
SlopeScene rails(const PairOptions& options, pliant::Real degrees);
/// The same of a solid whose lower edges lie across the ridges of two pinned roofs.
SlopeScene ridges(const PairOptions& options, pliant::Real degrees);
PairScene slope2_steep(const PairOptions& options);       ///< 30°
PairScene slope2_near_limit(const PairOptions& options);  ///< 17°, 0.3° more than a friction of 0.3 holds
PairScene slope2_gentle(const PairOptions& options);      ///< 16°, which it holds

}  // namespace pliant_tests
