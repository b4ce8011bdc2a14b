#include "pliant/mesh/shapes/limits.h"

#include <fmt/format.h>

#include "pliant/core/error.h"

namespace pliant {

void require_vertex_count(std::string_view options, Real count) {
  if (count > Real{max_shape_vertices}) {
    fail_input(fmt::format("{} ask for {:.3g} vertices; stay under {}", options, count, max_shape_vertices));
  }
}

}  // namespace pliant
