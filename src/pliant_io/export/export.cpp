#include "pliant_io/export/export.h"

#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant_io/export/animation_format.h"
#include "pliant_io/export/keyframes.h"
#include "pliant_io/mesh/mesh_file.h"
#include "pliant_io/recorder/detail/one_mesh.h"

namespace pliant {

namespace fs = std::filesystem;

namespace {

std::vector<std::size_t> all_frames(const Animation& animation) {
  std::vector<std::size_t> frames(animation.times.size());
  std::iota(frames.begin(), frames.end(), std::size_t{0});
  return frames;
}

/// All frames, unless the format interpolates between fewer.
Keyframes keyframes_for(const AnimationFormat& format, const Animation& animation, const ExportOptions& options) {
  if (format.thins == AnimationFormat::Thins::always) {
    return choose_keyframes(animation, options.tolerance.value_or(default_gltf_tolerance), options.max_keyframes);
  }
  if (!options.tolerance) return {all_frames(animation), 0};
  if (format.thins == AnimationFormat::Thins::never) {
    fail_input(fmt::format("a tolerance of {}, but {} files hold all frames; leave it out, or take glb, gltf or usda",
                           *options.tolerance, format.name));
  }
  return choose_keyframes(animation, *options.tolerance, std::numeric_limits<std::int64_t>::max());
}

void check_bodies(const fs::path& path, const Animation& animation) {
  if (!animation.bodies.empty()) return;
  fail_input(fmt::format("{}: a point cache alone has no faces; give its mesh by --mesh", path.string()));
}

/// Where the digits of a sequence stand in the name of its files.
struct Digits {
  std::size_t first;
  std::size_t count;
};

Digits digits_of(const std::string& name) {
  const std::size_t first = name.find('#');
  const std::size_t last = name.find_last_of('#');
  if (first == name.npos || name.find_first_not_of('#', first) < last) {
    fail_input(
        fmt::format("{}: the name of a sequence has one run of # in the place of the frame's number, as in "
                    "frame_#####.obj; correct it, or choose one frame by --frames or --time",
                    name));
  }
  return {first, last - first + 1};
}

}  // namespace

bool are_alike(const SurfaceSide& a, const SurfaceSide& b) {
  if (!a.image || !b.image) return a.image == b.image && a.color == b.color;
  return a.image == b.image || (a.image->format == b.image->format && a.image->bytes == b.image->bytes);
}

ExportReport export_animation(const fs::path& path, const Animation& animation, const ExportOptions& options) {
  const std::optional<AnimationFormat> format = animation_format(path);
  if (!format) {
    fail_input(
        fmt::format("{}: unknown format of an animation; give one of {}", path.string(), animation_extensions()));
  }
  const Keyframes keyframes = keyframes_for(*format, animation, options);
  if (format->needs == AnimationFormat::Needs::faces) {
    at_place(path.string(), [&] { check_bodies(path, animation); });
  }
  const ExportReport report = {std::ssize(animation.times), std::ssize(keyframes.frames), keyframes.largest_error};
  if (report.keyframes < report.frames && options.before_thinning) options.before_thinning(report);
  at_place(path.string(), [&] { format->write(path, animation, keyframes.frames, options); });
  return report;
}

std::int64_t export_sequence(const fs::path& pattern, const Animation& animation) {
  check_bodies(pattern, animation);
  const std::string name = pattern.filename().string();
  const Digits digits = digits_of(name);
  const Mesh mesh = one_mesh(animation.bodies);
  Positions positions;
  for (std::size_t frame = 0; frame < animation.times.size(); ++frame) {
    animation.cache.sample(animation.times[frame], positions);
    std::string file = name;
    file.replace(digits.first, digits.count, fmt::format("{:0{}}", frame, digits.count));
    write_mesh(pattern.parent_path() / file, mesh, positions);
  }
  return std::ssize(animation.times);
}

void export_frame(const fs::path& path, const Animation& animation) {
  check_bodies(path, animation);
  if (animation.times.size() > 1) {
    fail_input(
        fmt::format("{}: {} frames do not fit a file of one; give a place for their numbers, as in "
                    "frame_#####.obj, or choose one by --frames or --time",
                    path.string(), animation.times.size()));
  }
  Positions positions;
  animation.cache.sample(animation.times.front(), positions);
  write_mesh(path, one_mesh(animation.bodies), positions);
}

}  // namespace pliant
