#pragma once
#include "pliant/solver/global/factorization/factorization.h"

namespace pliant {

std::unique_ptr<Factorization> make_eigen_factorization();

}  // namespace pliant
