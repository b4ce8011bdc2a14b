#pragma once
// Where a collider begins, as its entry of a scene file says it.
#include "pliant/collision/colliders/collider.h"
#include "viewer/json_of.h"

namespace pliant_viewer {

/// The keys of the entry of a collider that stands in this pose, with their values. Those of its rotation are left out
/// where the entry has that rotation already.
Json pose_keys(const Json& entry, const pliant::Pose& pose);

}  // namespace pliant_viewer
