#pragma once
// Numbers as people would write them, so that the panel and a saved scene tell the same.
#include "pliant/core/types.h"

namespace pliant_viewer {

/// To so many decimal digits from the first one that counts, 1 to 17; what is not finite stays.
pliant::Real with_digits(pliant::Real number, int digits);
/// The same for the greatest of its numbers, the others to the same decimal place.
pliant::Vec3 with_digits(const pliant::Vec3& vector, int digits);
/// Of a number that was made of one in single precision the shortest that is the same in that, 0.3 for
/// 0.30000001192092896; another one as it is.
pliant::Real without_single_precision(pliant::Real number);
pliant::Vec3 without_single_precision(const pliant::Vec3& vector);

}  // namespace pliant_viewer
