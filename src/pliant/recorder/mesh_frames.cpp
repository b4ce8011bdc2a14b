#include <fmt/format.h>

#include "pliant/mesh/io/mesh_file.h"
#include "pliant/recorder/detail/one_mesh.h"
#include "pliant/recorder/frame_writer.h"
#include "pliant/recorder/run_files.h"

namespace pliant {
namespace {

/// One mesh file a frame.
class MeshFrames final : public FrameWriter {
 public:
  MeshFrames(std::filesystem::path folder, std::string_view format, Mesh mesh)
      : folder_(std::move(folder)), format_(format), mesh_(std::move(mesh)) {}

  std::string_view format() const override { return format_; }
  std::filesystem::path path() const override { return folder_ / frames_name(format_); }
  void add(const Positions& positions) override {
    write_mesh(folder_ / frame_file_name(frame_count_, format_), mesh_, positions);
    ++frame_count_;
  }

 private:
  std::filesystem::path folder_;
  std::string format_;
  Mesh mesh_;
  std::int64_t frame_count_ = 0;
};

}  // namespace

std::unique_ptr<FrameWriter> make_obj_writer(const std::filesystem::path& folder, std::span<const Body> bodies) {
  return std::make_unique<MeshFrames>(folder, "obj", one_mesh(bodies));
}

std::unique_ptr<FrameWriter> make_ply_writer(const std::filesystem::path& folder, std::span<const Body> bodies) {
  return std::make_unique<MeshFrames>(folder, "ply", one_mesh(bodies));
}

}  // namespace pliant
