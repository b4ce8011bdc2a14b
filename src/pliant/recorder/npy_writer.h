#pragma once
// NumPy's array file, version 1.0 (numpy.lib.format): magic bytes, a Python dictionary padded to a multiple of 64
// bytes, then the numbers.
#include "pliant/recorder/frame_writer.h"
#include "pliant/recorder/output_file.h"

namespace pliant {

/// The header is written anew after every frame, so that the file is whole at any moment, also when a run is killed.
class NpyWriter final : public FrameWriter {
 public:
  /// Makes the file, with no frames. @throws Error (output)
  NpyWriter(std::filesystem::path path, Index vertex_count);

  std::string_view format() const override { return "npy"; }
  std::filesystem::path path() const override { return path_; }
  void add(const Positions& positions) override;

 private:
  std::filesystem::path path_;
  OutputFile file_;
  Index vertex_count_;
  std::int64_t frame_count_ = 0;
};

}  // namespace pliant
