#pragma once
// How a scene is shown, written into the scene.
#include "pliant_io/scene/scene_document.h"
#include "viewer/scene_changes.h"

namespace pliant_viewer {

/// Puts what differs from the defaults under the key "view", and whatever stands there already.
void write_view(const pliant::ViewSettings& view, pliant::SceneDocument& document);

/// Whether the scene leaves the place of the camera open, so that it is chosen as all is best seen.
bool leaves_place_open(const pliant::Camera& camera);

/// Whether a scene with the changes may be seen from elsewhere than without them, where that is left open: things that
/// came, went or begin elsewhere.
bool may_move_camera(const SceneChanges& changes);

}  // namespace pliant_viewer
