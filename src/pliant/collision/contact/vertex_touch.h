#pragma once
#include <limits>

#include "pliant/core/types.h"

namespace pliant {

/// What a vertex touches, colliders and surfaces together.
struct VertexTouch {
  /// To the nearest of what pushes it [m]; infinite where nothing does.
  Real gap = std::numeric_limits<Real>::infinity();
  /// On it, normal and friction [N].
  Vec3 force = Vec3::Zero();
};

}  // namespace pliant
