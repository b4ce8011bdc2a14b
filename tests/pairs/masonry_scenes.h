#pragma once
// Stiff blocks that stand on each other by their weight and friction alone.
#include "tests/pairs/pair_scene.h"

namespace pliant_tests {

/// Boxes of 0.2 m, 8.8 kg each, stand on each other and on a floor, a contact distance apart.
PairScene tower(const PairOptions& options, pliant::Index boxes);
PairScene tower_of_20(const PairOptions& options);  ///< with friction as the options have it

/// A semicircular arch of wedges without mortar on a floor: a mean radius of 1 m, a thickness of 0.2 m, 0.3 m deep.
PairScene arch(const PairOptions& options, pliant::Index wedges);
PairScene arch_of_11(const PairOptions& options);  ///< with friction as the options have it

/// How bodies stand, against how they were made.
struct Standing {
  pliant::Real highest = 0;   ///< the center of a body [m]
  pliant::Real sag = 0;       ///< the most that the center of a body has sunk [m]
  pliant::Real sideways = 0;  ///< the most that the center of a body has moved across gravity [m]
  pliant::Real fastest = 0;   ///< speed of a vertex [m/s]
};
Standing standing(const pliant::Simulation& simulation);

}  // namespace pliant_tests
