#pragma once
// How panels store what belongs to their own columns; panel_factor.h draws it.
#include <cstdint>

namespace pliant {

/// Panels of at most so many columns store (D Dᵀ)⁻¹ whole: one product in place of two that wait for each other. Wider
/// ones store D⁻¹, since a wide inverse in single precision is exact enough for its softest motions alone: with 64 in
/// place of 16, solves of bodies that nothing holds left up to 73 times as much (benchmarks/NOTES.md).
inline constexpr std::int32_t most_whole_columns = 16;

}  // namespace pliant
