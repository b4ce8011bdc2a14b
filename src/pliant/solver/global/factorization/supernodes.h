#pragma once
// A Cholesky factor as the back ends hand it over.
#include <cstddef>
#include <span>
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// A run of columns that share their rows below the diagonal block.
struct Supernode {
  Index columns = 0;
  std::span<const Index> rows_below;  ///< ascending
  const Real* values = nullptr;  ///< L by columns, each from its diagonal on or, in a `rectangle`, from the first row
  bool is_rectangle = false;

  Index rows() const { return columns + static_cast<Index>(rows_below.size()); }
  /// From the diagonal on.
  const Real* column(Index c) const {
    const auto place = static_cast<std::ptrdiff_t>(c);
    if (is_rectangle) return values + place * rows() + place;
    return values + place * rows() - place * (place - 1) / 2;
  }
};

/// All of them, those of the first columns first. The data belongs to the back end, until it factorizes again.
struct FactorView {
  std::span<const Index> permutation;  ///< the row that stands in each place
  std::vector<Supernode> supernodes;
};

}  // namespace pliant
