#pragma once
// Few frames between which the others are nearly straight lines.
#include <vector>

#include "pliant_io/export/animation.h"

namespace pliant {

struct Keyframes {
  std::vector<std::size_t> frames;  ///< indices into Animation::times, rising; the first and the last are among them
  Real largest_error = 0;           ///< farthest that linear interpolation is off, in sizes of the vertex's body
};

/// The sizes that tolerances are given in [m]: of each body the diagonal of its bounding box in the first frame or,
/// where that is 0, of its way; 1 for what is a point and stays there. Without bodies, of all points as one.
std::vector<Real> body_sizes(const Animation& animation);

/// Chooses keyframes so that linear interpolation in time misses no vertex of any frame by more than `tolerance` ≥ 0,
/// in sizes of its body. From each keyframe on, the next is as far away as it may be, which on recorded motion takes as
/// many keyframes as the best choice does. When that would be more than max_count ≥ 2, the tolerance is raised to the
/// least one that needs no more, so that largest_error may exceed it.
/// @throws Error (input): a tolerance or a count out of range.
Keyframes choose_keyframes(const Animation& animation, Real tolerance, std::int64_t max_count);

}  // namespace pliant
