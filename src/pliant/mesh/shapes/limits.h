#pragma once
#include <string_view>

#include "pliant/core/types.h"

namespace pliant {

/// A shape with more vertices than this is refused, as a slip of the keyboard.
inline constexpr Index max_shape_vertices = 20'000'000;

/// Throws Error (input) that names the options when they ask for more. The count is a floating-point number because
/// the product of three counts may exceed every integer.
void require_vertex_count(std::string_view options, Real count);

}  // namespace pliant
