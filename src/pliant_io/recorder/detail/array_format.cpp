#include "pliant_io/recorder/detail/array_format.h"

#include <array>
#include <bit>
#include <limits>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant_io/files/detail/npy.h"

namespace pliant {
namespace {

static_assert(std::endian::native == std::endian::little, "doubles and PC2 are written as they lie in memory");

template <typename Number>
void append_number(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

std::string frames_npy_header(std::int64_t frame_count, Index vertex_count) {
  return npy_header("<f8", std::array<std::int64_t, 3>{frame_count, vertex_count, 3});
}

void append_doubles(std::string& bytes, const Positions& positions) {
  bytes.append(reinterpret_cast<const char*>(positions.data()),
               static_cast<std::size_t>(positions.size()) * sizeof(Real));
}

std::string pc2_header(std::int64_t frame_count, Index vertex_count) {
  constexpr std::int32_t version = 1;
  constexpr float start_frame = 0;
  constexpr float sample_rate = 1;
  if (frame_count > std::numeric_limits<std::int32_t>::max()) {
    fail_input(fmt::format("{} frames are too many for a PC2 file; take fewer, or the format npy", frame_count));
  }
  std::string bytes("POINTCACHE2\0", 12);
  append_number(bytes, version);
  append_number(bytes, vertex_count);
  append_number(bytes, start_frame);
  append_number(bytes, sample_rate);
  append_number(bytes, static_cast<std::int32_t>(frame_count));
  return bytes;
}

void append_floats(std::string& bytes, const Positions& positions) {
  for (Index v = 0; v < positions.rows(); ++v) {
    const Eigen::Vector3f position = single_precision(positions, v);
    bytes.append(reinterpret_cast<const char*>(position.data()), sizeof(float) * 3);
  }
}

}  // namespace

const ArrayFormat npy_format = {"npy", frames_npy_header, append_doubles};
const ArrayFormat pc2_format = {"pc2", pc2_header, append_floats};

Eigen::Vector3f single_precision(const Positions& positions, Index vertex) {
  const Eigen::Vector3f position = row(positions, vertex).cast<float>();
  if (position.allFinite()) return position;
  fail_input(
      fmt::format("vertex {}: its position is out of the range of single precision; write the format npy, or "
                  "fewer frames",
                  vertex));
}

}  // namespace pliant
