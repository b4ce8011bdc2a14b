// Point caches of an animation: all frames, no mesh.
#include <bit>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant_io/export/detail/export_formats.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/recorder/detail/array_format.h"

namespace pliant {
namespace {

template <typename Number>
void append_big_endian(std::string& bytes, Number number) {
  static_assert(sizeof number == 4);
  const std::uint32_t bits = __builtin_bswap32(std::bit_cast<std::uint32_t>(number));
  bytes.append(reinterpret_cast<const char*>(&bits), sizeof bits);
}

void write_array(const std::filesystem::path& path, const Animation& animation, const std::vector<std::size_t>& frames,
                 const ArrayFormat& format) {
  AtomicFile file(path);
  file.write(format.header(std::ssize(frames), animation.cache.vertex_count()));
  Positions positions;
  std::string bytes;
  for (const std::size_t frame : frames) {
    animation.cache.sample(animation.times[frame], positions);
    bytes.clear();
    format.append(bytes, positions);
    file.write(bytes);
  }
  file.commit();
}

}  // namespace

void write_npy(const std::filesystem::path& path, const Animation& animation, const std::vector<std::size_t>& frames,
               const ExportOptions& /*options*/) {
  write_array(path, animation, frames, npy_format);
}

void write_pc2(const std::filesystem::path& path, const Animation& animation, const std::vector<std::size_t>& frames,
               const ExportOptions& /*options*/) {
  if (frame_rate(animation.times) == 0) {
    fail_input(
        fmt::format("{}: the frames are not evenly spaced in time, as those of a PC2 file are; give frames per "
                    "second by --fps, or write MDD",
                    path.string()));
  }
  write_array(path, animation, frames, pc2_format);
}

void write_mdd(const std::filesystem::path& path, const Animation& animation, const std::vector<std::size_t>& frames,
               const ExportOptions& /*options*/) {
  if (frames.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    fail_input(fmt::format("{}: too many frames for an MDD file; take fewer by --frames", path.string()));
  }
  AtomicFile file(path);
  std::string bytes;
  append_big_endian(bytes, static_cast<std::int32_t>(frames.size()));
  append_big_endian(bytes, std::int32_t{animation.cache.vertex_count()});
  for (const float time : single_precision_times(animation, frames)) append_big_endian(bytes, time);
  Positions positions;
  for (const std::size_t frame : frames) {
    animation.cache.sample(animation.times[frame], positions);
    for (Index v = 0; v < positions.rows(); ++v) {
      for (const float coordinate : single_precision(positions, v)) append_big_endian(bytes, coordinate);
    }
    file.write(bytes);
    bytes.clear();
  }
  file.commit();
}

std::vector<float> single_precision_times(const Animation& animation, const std::vector<std::size_t>& frames) {
  std::vector<float> times;
  for (const std::size_t frame : frames) {
    const auto time = static_cast<float>(time_from_start(animation, frame));
    if (!times.empty() && !(time > times.back())) {
      fail_input(
          fmt::format("frame {}: its time, {} s, is that of the frame before in single precision; take fewer "
                      "frames by --frames or --fps",
                      frame, time));
    }
    times.push_back(time);
  }
  return times;
}

}  // namespace pliant
