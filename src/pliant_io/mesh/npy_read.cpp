// NPY: NumPy's array, frames × m × 3 of float32 or float64.
#include "pliant_io/files/detail/npy.h"
#include "pliant_io/mesh/detail/cache_readers.h"

namespace pliant {

PointCache read_npy_cache(std::string bytes, std::string_view name, Real frames_per_second) {
  const NpyHeader header = read_npy_header(ByteSource(bytes, name));
  if (header.type != "<f8" && header.type != "<f4") {
    fail_cache(name, "header: 'descr' is neither '<f4' nor '<f8'; save the array with dtype float32 or float64");
  }
  if (header.is_fortran_order) {
    fail_cache(name, "header: 'fortran_order' is not False; save numpy.ascontiguousarray(positions)");
  }
  if (header.shape.size() != 3 || header.shape.back() != 3) {
    fail_cache(name, "header: 'shape' is not (frames, vertices, 3); save the positions as such an array");
  }
  const CacheCounts counts = {header.shape[0], header.shape[1]};
  const bool is_double = header.type == "<f8";
  const auto first = static_cast<std::size_t>(header.first_byte);
  check_cache_size(name, bytes, first, counts, is_double ? sizeof(double) : sizeof(float), CacheTail::allowed);
  const auto scalar = is_double ? PointCache::Scalar::float64 : PointCache::Scalar::float32;
  return {std::move(bytes),
          {first, scalar, static_cast<Index>(counts.vertices)},
          even_times(counts.frames, 0, 1, frames_per_second)};
}

}  // namespace pliant
