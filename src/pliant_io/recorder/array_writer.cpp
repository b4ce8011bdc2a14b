#include <algorithm>
#include <fstream>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/recorder/detail/array_format.h"
#include "pliant_io/recorder/frame_writer.h"
#include "pliant_io/recorder/output_file.h"

namespace pliant {
namespace {

/// The header is written anew after every frame, so that the file is whole at any moment, also when a run is killed.
class ArrayWriter final : public FrameWriter {
 public:
  ArrayWriter(std::filesystem::path path, const ArrayFormat& format, Index vertex_count)
      : path_(std::move(path)), file_(path_), format_(format), vertex_count_(vertex_count) {
    file_.write(format_.header(0, vertex_count_));
    file_.flush();
  }

  /// Goes on behind frames that are there.
  ArrayWriter(std::filesystem::path path, const ArrayFormat& format, Index vertex_count, std::int64_t kept_frames)
      : path_(std::move(path)),
        file_(path_, kept_bytes(path_, format, vertex_count, kept_frames)),
        format_(format),
        vertex_count_(vertex_count),
        frame_count_(kept_frames) {
    file_.write_at_start(format_.header(frame_count_, vertex_count_));
    file_.flush();
  }

  std::string_view format() const override { return format_.name; }
  std::filesystem::path path() const override { return path_; }

  void add(const Positions& positions) override {
    if (positions.rows() != vertex_count_) {
      fail_input(fmt::format("{}: a frame of {} vertices among frames of {}; begin another file", path_.string(),
                             positions.rows(), vertex_count_));
    }
    bytes_.clear();
    at_place(path_.string(), [&] { format_.append(bytes_, positions); });
    file_.write(bytes_);
    file_.flush();  // the frame must be there before the header counts it
    ++frame_count_;
    file_.write_at_start(format_.header(frame_count_, vertex_count_));
    file_.flush();
  }

 private:
  /// The header on the disk counts the frames there are, or one less when a run was killed between the two.
  static std::uintmax_t kept_bytes(const std::filesystem::path& path, const ArrayFormat& format, Index vertex_count,
                                   std::int64_t kept_frames) {
    std::string bytes;
    format.append(bytes, Positions::Zero(vertex_count, 3));
    const std::uintmax_t header = format.header(0, vertex_count).size();
    const std::string begin = read_begin(path, header);
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    const auto frames = static_cast<std::int64_t>((size - std::min(size, header)) / bytes.size());
    const bool is_ours = !error && (begin == format.header(frames, vertex_count) ||
                                    begin == format.header(std::max<std::int64_t>(frames - 1, 0), vertex_count));
    if (is_ours && frames >= kept_frames) return header + bytes.size() * static_cast<std::uintmax_t>(kept_frames);
    fail_input(
        fmt::format("{}: not {} frames of {} vertices, after which this run would go on; run the scene from its "
                    "start, or put that file back",
                    printable_place(path.string()), kept_frames, vertex_count));
  }

  static std::string read_begin(const std::filesystem::path& path, std::uintmax_t size) {
    std::ifstream file(path, std::ios::binary);
    std::string bytes(static_cast<std::size_t>(size), '\0');
    file.read(bytes.data(), static_cast<std::streamsize>(size));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return bytes;
  }

  std::filesystem::path path_;
  OutputFile file_;
  const ArrayFormat& format_;
  Index vertex_count_;
  std::int64_t frame_count_ = 0;
  std::string bytes_;  ///< scratch
};

}  // namespace

namespace {

std::unique_ptr<FrameWriter> make_writer(const std::filesystem::path& path, const ArrayFormat& format,
                                         Index vertex_count, std::int64_t kept_frames) {
  if (kept_frames == 0) return std::make_unique<ArrayWriter>(path, format, vertex_count);
  return std::make_unique<ArrayWriter>(path, format, vertex_count, kept_frames);
}

}  // namespace

std::unique_ptr<FrameWriter> make_npy_writer(const std::filesystem::path& folder, Index vertex_count,
                                             std::int64_t kept_frames) {
  return make_writer(folder / "frames.npy", npy_format, vertex_count, kept_frames);
}

std::unique_ptr<FrameWriter> make_pc2_writer(const std::filesystem::path& folder, Index vertex_count,
                                             std::int64_t kept_frames) {
  return make_writer(folder / "frames.pc2", pc2_format, vertex_count, kept_frames);
}

}  // namespace pliant
