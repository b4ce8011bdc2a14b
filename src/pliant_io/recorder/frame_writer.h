#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "pliant/simulation/simulation.h"

namespace pliant {

/// Writes the positions of a run, frame by frame. Derive from it for a format of one's own.
class FrameWriter {
 public:
  virtual ~FrameWriter() = default;

  /// The format's name, for run.json.
  virtual std::string_view format() const = 0;
  /// Where the frames are, for people: a file, or a pattern of files.
  virtual std::filesystem::path path() const = 0;
  /// Writes one more frame, m × 3 [m]. When it returns, or throws Error(output), all frames written before it are
  /// whole on the disk.
  virtual void add(const Positions& positions) = 0;
};

// The writers below begin anew, or go on behind the first `kept_frames` frames that an earlier run left in the folder:
// the others are cut off, or replaced as the run goes on. Throws Error(input) when there are fewer, or of another size.

/// All frames in `folder`/frames.npy: float64, frames × m × 3, C order. The vertices are those of all bodies in turn.
std::unique_ptr<FrameWriter> make_npy_writer(const std::filesystem::path& folder, Index vertex_count,
                                             std::int64_t kept_frames = 0);

/// All frames in `folder`/frames.pc2, the point cache that Blender and Houdini read on top of mesh.obj: float32. A
/// frame of the cache is one frame of theirs.
std::unique_ptr<FrameWriter> make_pc2_writer(const std::filesystem::path& folder, Index vertex_count,
                                             std::int64_t kept_frames = 0);

/// One file a frame, `folder`/frame_00000.obj and so on; several bodies are objects of that file (`o`, by their names).
std::unique_ptr<FrameWriter> make_obj_writer(const std::filesystem::path& folder, std::span<const Body> bodies,
                                             std::int64_t kept_frames = 0);

/// One binary file a frame, `folder`/frame_00000.ply and so on, of all bodies.
std::unique_ptr<FrameWriter> make_ply_writer(const std::filesystem::path& folder, std::span<const Body> bodies,
                                             std::int64_t kept_frames = 0);

/// One of these by the name of its format, as run.json has it: "npy", "pc2", "obj" or "ply"; null for "none".
/// @throws Error (input): no such format
std::unique_ptr<FrameWriter> make_frame_writer(std::string_view format, const std::filesystem::path& folder,
                                               const Simulation& simulation, std::int64_t kept_frames = 0);

}  // namespace pliant
