#pragma once
// What a batch requires of each constraint that is added to it.
#include <string>

#include "pliant/constraints/constraint_group.h"
#include "pliant/core/error.h"

namespace pliant {

/// Throws Error(input) on coefficients that do not sum to zero, of a type that says that they do.
void check_sum_of_row(std::string_view type, std::span<const Real> coefficients);

/// Throws Error(input) on a constraint of the wrong number of vertices, coefficients or fields.
void check_numbers(std::string_view type, const GroupShape& shape, std::size_t fields, std::size_t stencil_size,
                   std::size_t reduction_size, std::size_t field_count);

/// Both; and of differences, whose kernel reads no coefficients, Error(input) on others than −1, 1.
template <class Type>
void check_constraint(std::string_view type, const GroupShape& shape, std::size_t stencil_size,
                      std::span<const Real> reduction, std::size_t field_count) {
  check_numbers(type, shape, Type::fields, stencil_size, reduction.size(), field_count);
  if constexpr (requires { Type::is_difference; }) {
    if (reduction[0] != -1 || reduction[1] != 1) fail_input(std::string(type) + ": its coefficients are -1, 1");
  }
  const auto n = static_cast<std::size_t>(shape.vertices);
  for (std::size_t row = 0; Type::translation_invariant && row < Type::rows; ++row)
    check_sum_of_row(type, reduction.subspan(row * n, n));
}

}  // namespace pliant
