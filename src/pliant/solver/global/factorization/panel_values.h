#pragma once
// The values of one panel from those of its supernode.
#include "pliant/solver/global/factorization/supernodes.h"

namespace pliant {

/// L ← L⁻¹, where L is a lower triangle of n columns, column after column of n. What stands above the diagonal stays.
void invert_lower_triangle(Real* L, Index n);

/// Writes a panel in the order of panel_factor.h: (D Dᵀ)⁻¹ times unit², or D⁻¹ times `unit`, a power of two, and B D⁻¹.
/// `work` is room for blocks; it grows as needed.
template <class T>
void write_panel(const Supernode& s, Real unit, std::vector<Real>& work, T* out);

}  // namespace pliant
