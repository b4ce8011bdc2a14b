#pragma once
// On which side of a plane a point lies, without rounding.
#include "pliant/core/types.h"

namespace pliant {

/// The sign of det(x1 − x0, x2 − x0, x3 − x0): 1 where the tetrahedron x0 x1 x2 x3 has a positive volume, as those of a
/// mesh have, −1 where it is inverted, 0 where the four points lie exactly in one plane.
///
/// Seen from x3, x0 x1 x2 then run counter-clockwise. A first evaluation in double precision decides where its error
/// bound allows; else the determinant is summed without any rounding, as an expansion of doubles.
///
/// Source: J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates, Discrete
/// & Computational Geometry 18 (1997): sections 2.1 to 2.5 (expansions), 4.3 and 4.4 (orientation, its error bound).
///
/// Range: exact for all finite coordinates, of any magnitude, as long as those of the four points that are not zero
/// differ by less than a factor of 2^300, about 1e90; they are scaled by a power of two before. Past that, products of
/// the small ones with one another may underflow, and the sign is that of a determinant without them. Of coordinates
/// that are not finite the sign is 0.
int orientation(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3);

}  // namespace pliant
