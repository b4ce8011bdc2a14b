#include "pliant/solver/acceleration/accelerator.h"

namespace pliant {

bool Accelerator::has_risen(const LocalResult& now) const {
  constexpr Real rounding = 1e-12;
  const Real before = local_before_.objective();
  return !(now.objective() <= before + rounding * before + now.rounding);
}

Real Accelerator::best_share(const LocalResult& now) const {
  if (!has_moved_) return 0;
  const Real rise = now.objective() - local_before_.objective();
  return rise + slope() > 0 ? slope() / (2 * (rise + slope())) : 0;
}

}  // namespace pliant
