#include "pliant/constraints/batch.h"

namespace pliant {

void check_sum_of_row(std::string_view type, std::span<const Real> coefficients) {
  Real sum = 0;
  Real magnitude = 0;
  for (const Real c : coefficients) {
    sum += c;
    magnitude += std::abs(c);
  }
  if (std::abs(sum) <= 1e-9 * magnitude || !std::isfinite(magnitude)) return;
  fail_input(std::string(type) + ": the coefficients of a row sum to " + std::to_string(sum) +
             ", not to zero; mend them, or declare the type not translation_invariant");
}

}  // namespace pliant
