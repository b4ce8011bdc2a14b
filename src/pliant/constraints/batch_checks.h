#pragma once
// What a batch requires of each constraint that is added to it.
#include "pliant/constraints/constraint_group.h"

namespace pliant {

/// Throws Error(input) on coefficients that do not sum to zero, of a type that says that they do.
void check_sum_of_row(std::string_view type, std::span<const Real> coefficients);

/// Throws Error(input) on a constraint of the wrong number of vertices, coefficients or fields.
void check_numbers(std::string_view type, const GroupShape& shape, std::size_t fields, std::size_t stencil_size,
                   std::size_t reduction_size, std::size_t field_count);

}  // namespace pliant
