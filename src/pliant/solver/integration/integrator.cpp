#include "pliant/solver/integration/integrator.h"

#include <cmath>
#include <complex>

namespace pliant {

Real amplification(Integrator integrator, Real h_omega) {
  if (integrator == Integrator::implicit_euler) return 1 / std::hypot(1, h_omega);  // (λ − 1)/λ = ihω
  // (3λ² − 4λ + 1)/(2λ²) = ihω
  const std::complex<Real> root = std::sqrt(std::complex<Real>(1, 2 * h_omega));
  const std::complex<Real> below(3, -2 * h_omega);
  return std::max(std::abs((2.0 + root) / below), std::abs((2.0 - root) / below));
}

}  // namespace pliant
