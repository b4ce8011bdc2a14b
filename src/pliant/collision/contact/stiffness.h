#pragma once
// How stiff contacts are, and when they become stiffer.
#include "pliant/core/types.h"

namespace pliant {

/// k in units of m/h².
inline constexpr Real stiffness_ratio = 50;
/// κ of a vertex goes up where it is pressed below this share of r, and slowly down above the other one.
inline constexpr Real pressed_gap = 0.3;
inline constexpr Real light_gap = 0.6;
inline constexpr Real stiffer = 2;
inline constexpr Real softer = 0.98;
inline constexpr Real far_stiffer = 4;

}  // namespace pliant
