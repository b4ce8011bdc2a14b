#include "pliant/forces/force.h"

namespace pliant {

std::optional<Index> Force::vertex_out_of_range(Index) const {
  return std::nullopt;
}

Real Force::potential(const StateView&) const {
  return 0;
}

std::optional<std::string> Force::warning(const StateView&, Real) const {
  return std::nullopt;
}

}  // namespace pliant
