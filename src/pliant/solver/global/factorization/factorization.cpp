#include "pliant/solver/global/factorization/factorization.h"

#include "pliant/core/error.h"
#include "pliant/solver/global/factorization/cholmod_factorization.h"
#include "pliant/solver/global/factorization/eigen_factorization.h"

namespace pliant {
namespace {

#ifdef PLIANT_HAS_CHOLMOD
constexpr bool has_cholmod = true;
#else
constexpr bool has_cholmod = false;
#endif

}  // namespace

#ifndef PLIANT_HAS_CHOLMOD
std::unique_ptr<Factorization> make_cholmod_factorization(Ordering) {
  fail_input("backend: this build has no CHOLMOD; build with -DPLIANT_CHOLMOD=ON, or use `eigen`");
}
#endif

std::unique_ptr<Factorization> make_factorization(Backend backend, Ordering ordering) {
  if (backend == Backend::automatic) backend = has_cholmod ? Backend::cholmod : Backend::eigen;
  if (backend == Backend::cholmod) return make_cholmod_factorization(ordering);
  if (ordering == Ordering::nested_dissection) {
    fail_input(
        "ordering: nested dissection is METIS's, which the back end `eigen` does not have; give `cholmod`, or "
        "the ordering `automatic`");
  }
  return make_eigen_factorization();
}

}  // namespace pliant
