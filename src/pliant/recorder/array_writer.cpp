#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/recorder/detail/array_format.h"
#include "pliant/recorder/frame_writer.h"
#include "pliant/recorder/output_file.h"

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

  std::string_view format() const override { return format_.name; }
  std::filesystem::path path() const override { return path_; }

  void add(const Positions& positions) override {
    if (positions.rows() != vertex_count_) {
      fail_input(fmt::format("{}: a frame of {} vertices among frames of {}; begin another file", path_.string(),
                             positions.rows(), vertex_count_));
    }
    bytes_.clear();
    format_.append(bytes_, positions);
    file_.write(bytes_);
    file_.flush();  // the frame must be there before the header counts it
    ++frame_count_;
    file_.write_at_start(format_.header(frame_count_, vertex_count_));
    file_.flush();
  }

 private:
  std::filesystem::path path_;
  OutputFile file_;
  const ArrayFormat& format_;
  Index vertex_count_;
  std::int64_t frame_count_ = 0;
  std::string bytes_;  ///< scratch
};

}  // namespace

std::unique_ptr<FrameWriter> make_npy_writer(const std::filesystem::path& folder, Index vertex_count) {
  return std::make_unique<ArrayWriter>(folder / "frames.npy", npy_format, vertex_count);
}

std::unique_ptr<FrameWriter> make_pc2_writer(const std::filesystem::path& folder, Index vertex_count) {
  return std::make_unique<ArrayWriter>(folder / "frames.pc2", pc2_format, vertex_count);
}

}  // namespace pliant
