#include "pliant/forces/force.h"

namespace pliant {

Real Force::potential(const StateView&) const {
  return 0;
}

std::optional<std::string> Force::warning(const StateView&, Real) const {
  return std::nullopt;
}

}  // namespace pliant
