#pragma once
// Cloth on what is told where to go: a figure that walks and whirls in a shirt, a ball that runs into a curtain, an arm
// that carries a sleeve round.
#include "tests/pairs/pair_scene.h"

namespace pliant_tests {

/// A figure of 1.8 m that walks, whirls twice about itself, walks back and whirls the other way, in 10 s, and what it
/// wears. Its last body is the shirt.
PairScene figure_in(const pliant::Mesh& shirt, const PairOptions& options);

/// In a shirt that is sewn of a front and a back.
PairScene shirt(const PairOptions& options);
pliant::Mesh shirt_mesh(pliant::Real edge);

/// In the shirt of ../shared/meshes/tshirt.obj, divided once where more than 4000 vertices are asked for; in the other
/// one where that file is not there.
PairScene tshirt(const PairOptions& options);

/// A ball of 0.4 m goes through the plane of a curtain that hangs by its upper border, at 5 m/s, or what is asked for.
PairScene ball_and_curtain(const PairOptions& options);

/// A sleeve on an arm that turns about its end, once in `turn` and twice in all, 0.4 m to 0.9 m from the axis.
PairScene sleeve(const PairOptions& options);

}  // namespace pliant_tests
