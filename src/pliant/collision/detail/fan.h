#pragma once
// The triangles around a point, and what lies on which side of them.
#include <array>
#include <optional>
#include <vector>

#include "pliant/core/types.h"

namespace pliant::collision {

/// The lines opposite a point x, in any order and direction: with x each spans a triangle of the fan.
using FanRing = std::vector<std::array<Vec3, 2>>;

/// A point that is not in the plane of the triangle, close enough to it that signs come out; none if a b c lie in a
/// line.
std::optional<Vec3> point_off_plane(const Vec3& a, const Vec3& b, const Vec3& c);

/// On which side of the fan of triangles around x each of the points lies, as seen from x: 1 and −1 are the two sides,
/// 0 lies exactly on the fan. The fan goes on to infinity from x, which is no point of `points`.
///
/// The sides differ where a way from one to the other passes through the fan an odd number of times. All 0 where there
/// are no two sides: the ring has an open end, or a triangle of the fan has no area.
std::vector<int> sides_of_fan(const Vec3& x, const FanRing& ring, const std::vector<Vec3>& points);

}  // namespace pliant::collision
