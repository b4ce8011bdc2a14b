#pragma once
// What a recorded run does not hold, found again from its scene: pins, forces and colliders at the time of each frame.
#include <functional>

#include "pliant_io/export/animation.h"
#include "pliant_io/scene/scene.h"

namespace pliant_render {

/// Goes through a run by the scene that it was made from, as it was at the start, without steps: its events act again,
/// and colliders go on with their velocities, along the paths of events and to where they are put. The bodies are where
/// the frames have them, and on the way between two frames; what follows them is as exact as that. Calls `visit` at
/// each frame with the step that it stands before.
/// @throws pliant::Error (input): an event that does not act as it did
void replay(pliant::Scene& scene, const pliant::PointCache& frames,
            const std::function<void(std::int64_t step)>& visit);

/// The colliders of a run that have a surface, with their poses in its frames and when each is there. One whose shape
/// changes goes, and another one of its name comes. Of one without end a square below the middle of the bodies at the
/// start is shown, six times as wide as they are.
/// @throws pliant::Error (input), as replay
std::vector<pliant::AnimatedCollider> recorded_colliders(pliant::Scene scene, const pliant::PointCache& frames);

}  // namespace pliant_render
