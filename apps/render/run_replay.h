#pragma once
// What a recorded run does not hold, found again from its scene: pins, forces and colliders at the time of each frame.
#include <functional>

#include "pliant_io/export/animation.h"
#include "pliant_io/scene/scene.h"

namespace pliant_render {

/// Goes through a run by the scene that it was made from, as it was at the start: its events act again, without steps,
/// and colliders go on with their velocities and to where events put them. Calls `visit` with the step that a frame
/// stands before, for each of the times, which rise.
/// @throws pliant::Error (input): an event that does not act as it did
void replay(pliant::Scene& scene, const std::vector<pliant::Real>& times,
            const std::function<void(std::int64_t step)>& visit);

/// The colliders that have a surface, with their poses at the times of a run. One that comes or goes stands still
/// before and after. Of one without end a square below the middle of the bodies at the start is shown, six times as
/// wide as they are.
/// @throws pliant::Error (input), as replay
std::vector<pliant::AnimatedCollider> recorded_colliders(pliant::Scene scene, const std::vector<pliant::Real>& times);

}  // namespace pliant_render
