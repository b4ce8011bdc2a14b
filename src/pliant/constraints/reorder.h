#pragma once
// Lists of constraints in another order.
#include <algorithm>
#include <span>
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// Item i of `to`, `size` numbers long, becomes item order[i] of `from`.
template <class T>
void take_in_order(std::span<const T> from, std::span<const Index> order, std::size_t size, std::span<T> to) {
  for (std::size_t i = 0; i < order.size(); ++i) {
    std::copy_n(from.data() + size * static_cast<std::size_t>(order[i]), size, to.data() + size * i);
  }
}

/// The same, as a new list.
template <class T>
std::vector<T> in_order(std::span<const T> from, std::span<const Index> order, std::size_t size) {
  std::vector<T> to(size * order.size());
  take_in_order(from, order, size, std::span<T>(to));
  return to;
}

}  // namespace pliant
