// Vertex maps, as text and as NumPy arrays: an Error or finite numbers.
#include <algorithm>
#include <cmath>

#include "fuzz.h"
#include "pliant_io/mesh/vertex_map.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  pliant_fuzz::expect_errors_only([&] {
    const std::vector<pliant::Real> values = pliant::parse_vertex_map(pliant_fuzz::text(data, size), "fuzz");
    pliant_fuzz::require(!values.empty(), "a map of no numbers");
    pliant_fuzz::require(std::ranges::all_of(values, [](pliant::Real x) { return std::isfinite(x); }),
                         "a number is not finite");
  });
  return 0;
}
