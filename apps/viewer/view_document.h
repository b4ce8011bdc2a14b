#pragma once
// How a scene is shown, written into the scene.
#include "pliant_io/scene/scene_document.h"

namespace pliant_viewer {

/// Puts what differs from the defaults under the key "view", and whatever stands there already.
void write_view(const pliant::ViewSettings& view, pliant::SceneDocument& document);

}  // namespace pliant_viewer
