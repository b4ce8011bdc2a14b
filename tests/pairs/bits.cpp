#include "tests/pairs/bits.h"

#include <cstring>

namespace pliant_tests {

using namespace pliant;

std::vector<Real> bits_of(const Simulation& simulation) {
  const State& state = simulation.state();
  std::vector<Real> bits(simulation.objective_history().begin(), simulation.objective_history().end());
  for (const Positions* x : {&state.positions, &state.velocities}) {
    bits.insert(bits.end(), x->data(), x->data() + x->size());
  }
  return bits;
}

bool same_bits(const std::vector<Real>& a, const std::vector<Real>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Real)) == 0;
}

}  // namespace pliant_tests
