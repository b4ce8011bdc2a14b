#pragma once
// A body that goes where it is told, whatever meets it: a figure, a floor of any shape. Every vertex is held, so that
// it costs next to nothing; other bodies meet its surface where surfaces touch (ContactSettings::surfaces).
//
//     const BodyId figure = simulation.add_body(mesh, Mass::area_density(1));
//     animate(simulation, timeline, figure, play(walk));
#include "pliant/timeline/timeline.h"

namespace pliant {

/// Holds every vertex of a body, and lets all of them go along a path from now on; without a path they stay. Returns
/// the group of positions, which can be moved, stopped, released and removed as any other; default name:
/// "<body>.animation". Throws Error(input), with both as they were, when the path does not fit.
GroupId animate(Simulation& simulation, Timeline& timeline, BodyId body, std::shared_ptr<Path> path = nullptr,
                std::string name = {});

/// Vertex i is where point i of the animation is, of which there are as many. See follow_animation.
std::shared_ptr<Path> play(std::shared_ptr<PointAnimation> animation);

}  // namespace pliant
