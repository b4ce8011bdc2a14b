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
             ", not to zero; fix them, or declare the type not translation_invariant");
}

void check_numbers(std::string_view type, const GroupShape& shape, std::size_t fields, std::size_t stencil_size,
                   std::size_t reduction_size, std::size_t field_count) {
  const auto n = static_cast<std::size_t>(shape.vertices);
  const auto rows = static_cast<std::size_t>(shape.rows);
  if (stencil_size == n && reduction_size == rows * n && field_count == fields) return;
  fail_input(std::string(type) + ": a constraint takes " + std::to_string(n) + " vertices, " +
             std::to_string(rows * n) + " coefficients and " + std::to_string(fields) + " fields");
}

}  // namespace pliant
