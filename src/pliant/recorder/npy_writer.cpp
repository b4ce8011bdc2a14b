#include "pliant/recorder/npy_writer.h"

#include <bit>

#include <fmt/format.h>

#include "pliant/core/error.h"

namespace pliant {
namespace {

static_assert(std::endian::native == std::endian::little, "the header says '<f8'");

/// 128 bytes whatever the counts, so that it can be replaced in place.
std::string header(std::int64_t frame_count, Index vertex_count) {
  constexpr std::size_t size = 128;
  std::string text("\x93NUMPY\x01\x00\x76\x00", 10);  // the dictionary has 0x76 = 118 bytes
  text += fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}, 3), }}", frame_count, vertex_count);
  text.resize(size - 1, ' ');
  text += '\n';
  return text;
}

}  // namespace

NpyWriter::NpyWriter(std::filesystem::path path, Index vertex_count)
    : path_(std::move(path)), file_(path_), vertex_count_(vertex_count) {
  file_.write(header(0, vertex_count_));
  file_.flush();
}

void NpyWriter::add(const Positions& positions) {
  if (positions.rows() != vertex_count_) {
    fail_input(fmt::format("{}: a frame of {} vertices among frames of {}; begin another file", path_.string(),
                           positions.rows(), vertex_count_));
  }
  const auto bytes = static_cast<std::size_t>(positions.size()) * sizeof(Real);
  file_.write({reinterpret_cast<const char*>(positions.data()), bytes});
  file_.flush();  // the frame must be there before the header counts it
  ++frame_count_;
  file_.write_at_start(header(frame_count_, vertex_count_));
  file_.flush();
}

std::unique_ptr<FrameWriter> make_npy_writer(const std::filesystem::path& folder, Index vertex_count) {
  return std::make_unique<NpyWriter>(folder / "frames.npy", vertex_count);
}

}  // namespace pliant
