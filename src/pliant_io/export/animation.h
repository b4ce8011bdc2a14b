#pragma once
// A moving mesh, to be exported: from the folder of a run, or a mesh and a point cache.
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "pliant/simulation/simulation.h"
#include "pliant_io/mesh/mesh_file.h"
#include "pliant_io/mesh/point_cache.h"

namespace pliant {

/// A collider of a run: a rigid surface that may move.
struct AnimatedCollider {
  std::string name;
  Mesh surface;                                        ///< in a frame of its own [m]
  Positions normals;                                   ///< one for each corner of its triangles
  std::vector<Real> times;                             ///< [s], rising, at least one
  std::vector<Pose> poses;                             ///< of the frame at each of the times
  Real from = -std::numeric_limits<Real>::infinity();  ///< when it comes [s], the first moment at which it is there
  Real until = std::numeric_limits<Real>::infinity();  ///< when it goes [s], the first moment at which it is not

  bool moves() const;
  bool is_there(Real time) const { return time >= from && time < until; }
  /// Between two times on the way from one pose to the other, before the first and after the last at rest.
  Pose pose_at(Real time) const;
};

struct Animation {
  std::string name;
  std::vector<Body> bodies;  ///< their vertices follow each other from 0; none when only the points are known
  PointCache cache;          ///< positions [m], +z up, with their times [s]
  std::vector<Real> times;   ///< of the frames to export [s], rising, at least one; the cache is sampled at them
  std::vector<AnimatedCollider> colliders{};
};

/// What a run left in its folder, also one that was cut off: mesh.obj, cut into its bodies, the frames in any format
/// and their times.
/// @throws Error (input) with the file, the place and the remedy: no such folder or not that of a run, a run without
///   frames, files that do not belong together.
Animation read_run(const std::filesystem::path& folder);

/// A mesh, as one body of that name, that a cache moves. @throws Error (input): another count of vertices.
Animation animate(Mesh mesh, std::string name, PointCache cache);

/// Bodies of a simulation that a cache moves, with the surfaces of what is solid, as the folder of a run has them; they
/// are where the first frame has them. @throws Error (input): another count of vertices.
Animation animate(std::string name, std::span<const Body> bodies, PointCache cache);

/// Points without a mesh.
Animation animate(std::string name, PointCache cache);

/// The same cache with its positions in meters and +z up, as read_mesh places a mesh.
/// @throws Error (input): a scale that is not a positive number, positions that are not finite with it.
PointCache place(PointCache cache, const ImportOptions& options);

/// A mesh that stands still: one frame.
Animation still(Mesh mesh, std::string name);

/// Keeps one body. @throws Error (input), with the names there are: none of that name.
void keep_body(Animation& animation, std::string_view name);

/// Frames `first` to `last`, both included, every `step`-th; negative ones count back from the last, which is -1.
struct FrameRange {
  std::int64_t first = 0;
  std::int64_t last = -1;
  std::int64_t step = 1;
};
/// Keeps a part of the frames. @throws Error (input): a frame that there is not, a range of none.
void keep_frames(Animation& animation, const FrameRange& range);

/// Keeps one moment [s], between frames or at one. @throws Error (input): before the first frame or after the last.
void keep_time(Animation& animation, Real time);

/// Takes the moments first, first + 1/rate, ... instead, up to the last frame. @throws Error (input): a rate that is
/// not a positive number, more than a million frames.
void resample(Animation& animation, Real frames_per_second);

/// Frames per second of evenly spaced times, 0 for others; those of a single frame are 24.
Real frame_rate(const std::vector<Real>& times);

}  // namespace pliant
