#pragma once
// The smooth curve through given points that shapes are made of.
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// Whether the last point of a curve is followed by the first one.
enum class CurveEnds { open, joined };

/// The centripetal Catmull-Rom spline through the points (C. Yuksel, S. Schaefer, J. Keyser: On the Parameterization of
/// Catmull-Rom Curves, 2009), as a line of 64 pieces from each given point to the next; its last point is the curve's
/// end. No two consecutive points are the same: two or more where it is open, three or more where it is joined.
std::vector<Vec3> smooth_curve(const std::vector<Vec3>& points, CurveEnds ends);

/// The length of a line from its start to each of its points [m].
std::vector<Real> lengths_along(const std::vector<Vec3>& line);

}  // namespace pliant
