#pragma once
// What a constraint pulls its z with, of weight 1: p − z with p its projection, or minus the gradient of its potential,
// where the type is a struct with
//     static Real potential(const Real* fields, const Real* z, Real* d);   // writes −du/dz, returns u; z, d: k × 3
// in place of project. Its energy is w u, and w/2 ‖z‖², times its factor share, is what the
// system matrix has for it.
#include <array>

#include "pliant/core/types.h"

namespace pliant {

template <class Type>
inline constexpr bool has_potential = requires {
  &Type::potential;
};

/// Writes the pull to d, rows × 3 numbers; returns the energy of weight 1.
template <class Type>
Real find_pull(const Real* fields, const Real* z, Real* d) {
  if constexpr (has_potential<Type>) {
    return Type::potential(fields, z, d);
  } else {
    constexpr std::size_t size = Type::rows * 3;
    std::array<Real, size> p;
    Type::project(fields, z, p.data());
    Real squared = 0;
    for (std::size_t a = 0; a < size; ++a) {
      d[a] = p[a] - z[a];
      squared += d[a] * d[a];
    }
    return squared / 2;
  }
}

}  // namespace pliant
