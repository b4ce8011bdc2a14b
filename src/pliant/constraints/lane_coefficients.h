#pragma once
// Coefficients in the order in which kernels read them: those of eight constraints side by side, so that each is loaded
// in all lanes at once. The first of a row, less the sum of the others, is left out.
#include <span>
#include <vector>

#include "pliant/constraints/kernels/local_kernels.h"
#include "pliant/core/types.h"

namespace pliant {

/// Of constraints with k rows of n coefficients each.
class LaneCoefficients {
 public:
  LaneCoefficients(int rows, int vertices)
      : rows_(static_cast<std::size_t>(rows)), vertices_(static_cast<std::size_t>(vertices)) {}

  void add(std::span<const Real> reduction) {
    if (count_ % lanes_of_coefficients == 0) numbers_.resize(numbers_.size() + lanes_of_coefficients * size());
    put(reduction, count_++, numbers_);
  }
  void add_all(std::span<const Real> reductions) {
    const std::size_t step = rows_ * vertices_;
    for (std::size_t first = 0; first < reductions.size(); first += step) add(reductions.subspan(first, step));
  }
  /// Those of `count` constraints from `first` on, until the next add(). Where they do not begin a row of lanes they
  /// are copied to `room`, which has k (n − 1) numbers for each, their count rounded up to whole rows.
  const Real* from(std::size_t first, std::size_t count, std::span<const Real> reductions, std::span<Real> room) const {
    if (first % lanes_of_coefficients == 0) return numbers_.data() + first * size();
    const std::size_t step = rows_ * vertices_;
    for (std::size_t i = 0; i < count; ++i) put(reductions.subspan((first + i) * step, step), i, room);
    return room.data();
  }

 private:
  std::size_t size() const { return rows_ * (vertices_ - 1); }
  void put(std::span<const Real> reduction, std::size_t i, std::span<Real> numbers) const {
    std::size_t place = i / lanes_of_coefficients * lanes_of_coefficients * size() + i % lanes_of_coefficients;
    for (std::size_t row = 0; row < rows_; ++row) {
      for (std::size_t j = 1; j < vertices_; ++j, place += lanes_of_coefficients) {
        numbers[place] = reduction[row * vertices_ + j];
      }
    }
  }

  std::size_t rows_, vertices_;
  std::size_t count_ = 0;
  std::vector<Real> numbers_;
};

}  // namespace pliant
