#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/mesh/mesh_file.h"
#include "pliant_io/recorder/detail/one_mesh.h"
#include "pliant_io/recorder/frame_writer.h"
#include "pliant_io/recorder/run_files.h"

namespace pliant {
namespace {

/// One mesh file a frame.
class MeshFrames final : public FrameWriter {
 public:
  MeshFrames(std::filesystem::path folder, std::string_view format, Mesh mesh, std::int64_t kept_frames)
      : folder_(std::move(folder)), format_(format), mesh_(std::move(mesh)), frame_count_(kept_frames) {
    for (std::int64_t frame = 0; frame < kept_frames; ++frame) {
      if (std::error_code ignored; std::filesystem::exists(file(frame), ignored)) continue;
      fail_input(
          fmt::format("{}: no such file, after which this run would go on; run the scene from its start, or put "
                      "that file back",
                      printable_place(file(frame).string())));
    }
    if (kept_frames == 0) return;
    std::error_code ignored;
    std::int64_t end = kept_frames;
    while (std::filesystem::exists(file(end), ignored)) ++end;
    // The last first: a run that is killed here leaves no gap, behind which the next one would not know them.
    while (end > kept_frames) std::filesystem::remove(file(--end), ignored);
  }

  std::string_view format() const override { return format_; }
  std::filesystem::path path() const override { return folder_ / frames_name(format_); }
  void add(const Positions& positions) override {
    write_mesh(file(frame_count_), mesh_, positions);
    ++frame_count_;
  }

 private:
  std::filesystem::path file(std::int64_t frame) const { return folder_ / frame_file_name(frame, format_); }

  std::filesystem::path folder_;
  std::string format_;
  Mesh mesh_;
  std::int64_t frame_count_ = 0;
};

}  // namespace

std::unique_ptr<FrameWriter> make_obj_writer(const std::filesystem::path& folder, std::span<const Body> bodies,
                                             std::int64_t kept_frames) {
  return std::make_unique<MeshFrames>(folder, "obj", one_mesh_of_run(bodies), kept_frames);
}

std::unique_ptr<FrameWriter> make_ply_writer(const std::filesystem::path& folder, std::span<const Body> bodies,
                                             std::int64_t kept_frames) {
  return std::make_unique<MeshFrames>(folder, "ply", one_mesh_of_run(bodies), kept_frames);
}

std::unique_ptr<FrameWriter> make_frame_writer(std::string_view format, const std::filesystem::path& folder,
                                               const Simulation& simulation, std::int64_t kept_frames) {
  if (format == "npy") return make_npy_writer(folder, simulation.state().vertex_count(), kept_frames);
  if (format == "pc2") return make_pc2_writer(folder, simulation.state().vertex_count(), kept_frames);
  if (format == "obj") return make_obj_writer(folder, simulation.bodies(), kept_frames);
  if (format == "ply") return make_ply_writer(folder, simulation.bodies(), kept_frames);
  if (format == "none") return nullptr;
  fail_input("no frames in the format '" + printable(format) + "'; give npy, pc2, obj, ply or none");
}

}  // namespace pliant
