#pragma once
#include "pliant/solver/factorization/factorization.h"

namespace pliant {

std::unique_ptr<Factorization> make_cholmod_factorization(Ordering ordering);

}  // namespace pliant
