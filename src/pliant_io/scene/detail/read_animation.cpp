#include "pliant_io/scene/detail/read_animation.h"

#include <filesystem>

#include "pliant/mesh/geometry.h"
#include "pliant/timeline/animated_body.h"
#include "pliant_io/mesh/follow_cache.h"
#include "pliant_io/mesh/mesh_file.h"
#include "pliant_io/mesh/mesh_sequence.h"
#include "pliant_io/mesh/point_cache_format.h"
#include "pliant_io/scene/animation_options.h"
#include "pliant_io/scene/detail/option_reader.h"
#include "pliant_io/scene/detail/read_mesh.h"
#include "pliant_io/scene/detail/scene_files.h"

namespace pliant {
namespace {

/// Of a sequence of meshes, or of a point cache.
PointCache read_frames(const Node& node, const PointCacheOptions& options) {
  const std::filesystem::path path = read_path(node);
  if (is_mesh_sequence(path)) {
    return node.locate([&] {
      const std::vector<SequenceFile> files = sequence_files(path);
      for (const SequenceFile& file : files) {
        for (const std::filesystem::path& each : mesh_files(file.path)) note_file(node, each);
      }
      return read_mesh_sequence(files, options);
    });
  }
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    node.fail("this is a folder; name the frames in it, as run/frames.npy or run/frame_*.obj");
  }
  const std::optional<PointCacheFormat> format = point_cache_format(path);
  if (!format) {
    node.fail(fmt::format("frames are one file ({}) or several meshes, whose numbers a star stands for: walk_*.obj",
                          point_cache_extensions()));
  }
  NamedFile named = read_named_file(node);
  return node.locate([&] { return PointCache::parse(std::move(named.bytes), named.path.string(), *format, options); });
}

/// From the coordinates of the body's mesh file to those of the scene.
std::vector<Positions> placed_frames(const Node& node, const Node& body, const PointCache& cache) {
  ImportOptions import;
  const Node mesh = body.require("mesh");
  if (mesh.has("file")) ImportOptions::visit(import, OptionReader{mesh});
  const std::optional<Node> transform = body.find("transform");
  std::vector<Positions> frames(static_cast<std::size_t>(cache.frame_count()));
  for (std::int64_t i = 0; i < cache.frame_count(); ++i) {
    Positions& x = frames[static_cast<std::size_t>(i)];
    cache.frame(i, x);
    node.locate([&] { import_positions(x, import, fmt::format("frame {}", i)); });
    if (transform) apply_transform(*transform, x);
    if (!(x.cwiseAbs().maxCoeff() <= coordinate_limit)) {
      node.fail(fmt::format("frame {}: a coordinate is past {:g} m; give a smaller scale", i, coordinate_limit));
    }
  }
  return frames;
}

BodyAnimation read_frame_animation(const Node& node, const Node& body, Index vertex_count) {
  FrameAnimation options;
  read_options(node, options, {"frames", "name"});
  if (const auto start = body.find("start_positions")) {
    start->fail("the first frame of the animation says where the vertices start; leave out one of the two");
  }
  const Node file = node.require("frames");
  const PointCache cache = read_frames(file, {.frames_per_second = options.frames_per_second});
  if (cache.vertex_count() != vertex_count) {
    file.fail(fmt::format("frames of {} vertices for a body of {}; give frames of its mesh", cache.vertex_count(),
                          vertex_count));
  }
  const std::vector<Positions> frames = placed_frames(file, body, cache);
  std::vector<Real> times(frames.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    times[i] = cache.time(static_cast<std::int64_t>(i)) - cache.time(0);
  }
  return file.locate([&]() -> BodyAnimation {
    std::shared_ptr<PointAnimation> animation = cached_animation(PointCache::from_frames(frames, std::move(times)));
    if (options.repeat) animation = repeated(std::move(animation));
    return {play(std::move(animation)), frames.front()};
  });
}

}  // namespace

BodyAnimation read_animation(const Node& node, const Node& body, Index vertex_count) {
  node.require_object();
  if (node.has("frames")) return read_frame_animation(node, body, vertex_count);
  for (const char* key : {"frames_per_second", "repeat"}) {
    if (const auto given = node.find(key)) given->fail("there are no frames; name them with the key 'frames'");
  }
  SteadyAnimation options;
  read_options(node, options, {"frames", "name"});
  if (options.velocity.isZero(0) && options.angular_velocity.isZero(0)) return {};
  return {steady_path(options.velocity, options.angular_velocity, options.center)};
}

}  // namespace pliant
