#include "pliant_io/export/animation.h"

#include <algorithm>
#include <cmath>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/export/detail/split_mesh.h"
#include "pliant_io/mesh/mesh_file.h"
#include "pliant_io/recorder/detail/one_mesh.h"
#include "pliant_io/recorder/detail/run_json.h"
#include "pliant_io/recorder/run_files.h"
#include "pliant_io/recorder/run_info.h"

namespace pliant {

namespace fs = std::filesystem;

namespace {

/// The positions of frames that are one mesh file each. A run that was killed could not count them, but left no gap.
PointCache read_mesh_frames(const fs::path& folder, const EarlierRun& run, Index vertex_count) {
  std::vector<Positions> frames;
  std::error_code ignored;
  for (std::int64_t frame = 0; !run.frame_count || frame < *run.frame_count; ++frame) {
    const fs::path path = folder / frame_file_name(frame, run.format);
    if (!run.frame_count && !fs::exists(path, ignored)) break;
    frames.push_back(read_mesh(path).vertices);
    if (frames.back().rows() == vertex_count) continue;
    fail_input(fmt::format("{}: has {} vertices, but mesh.obj {}; run the scene again", path.string(),
                           frames.back().rows(), vertex_count));
  }
  if (frames.empty()) fail_input(fmt::format("{}: has no frames; run the scene again", folder.string()));
  std::vector<Real> times(frames.size());
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = static_cast<Real>(i);
  return PointCache::from_frames(frames, std::move(times));
}

/// The times of the rows that were measured with the frames; one row may be missing, of the frame that was being
/// recorded when the run was killed.
std::vector<Real> times_of_run(const fs::path& folder, const EarlierRun& run, std::int64_t frame_count) {
  const fs::path path = folder / "measurements.csv";
  std::vector<Real> times = read_frame_times(path);
  if (times.empty()) {
    for (std::int64_t i = 0; i < frame_count; ++i) times.push_back(static_cast<Real>(i) * run.seconds_per_frame);
  }
  if (std::ssize(times) < frame_count - 1) {
    fail_input(
        fmt::format("{}: has {} rows for {} frames; run the scene again", path.string(), times.size(), frame_count));
  }
  times.resize(static_cast<std::size_t>(std::min<std::int64_t>(std::ssize(times), frame_count)));
  return times;
}

/// Frames of another run, or cut since, are noticed by what run.json says of them.
void check_frames(const fs::path& path, const EarlierRun& run, const PointCache& cache) {
  const auto fail = [&](const std::string& what) {
    fail_input(
        fmt::format("{}: {}: the two are not of one run; put the file back that belongs there, or run the scene "
                    "again",
                    printable_place(path.string()), what));
  };
  Index vertices = 0;
  for (const BodyRange& body : run.bodies) vertices += body.vertex_count;
  if (cache.vertex_count() != vertices) {
    fail(fmt::format("its frames have {} vertices, and run.json says {}", cache.vertex_count(), vertices));
  }
  if (run.frame_count && cache.frame_count() != *run.frame_count) {
    fail(fmt::format("it holds {} frames, and run.json says {}", cache.frame_count(), *run.frame_count));
  }
  if (!run.last_frame) return;
  Positions last;
  cache.frame(cache.frame_count() - 1, last);
  if (frame_checksum(last) != *run.last_frame) fail("its last frame is another than the one that run.json knows");
}

std::vector<Real> all_times(const PointCache& cache) {
  std::vector<Real> times(static_cast<std::size_t>(cache.frame_count()));
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = cache.time(static_cast<std::int64_t>(i));
  return times;
}

}  // namespace

bool AnimatedCollider::moves() const {
  return std::ranges::any_of(poses, [this](const Pose& pose) { return !(pose == poses.front()); });
}

Pose AnimatedCollider::pose_at(Real time) const {
  const auto after = std::ranges::upper_bound(times, time);
  if (after == times.begin()) return poses.front();
  if (after == times.end()) return poses.back();
  const auto next = static_cast<std::size_t>(after - times.begin());
  const Real share = (time - times[next - 1]) / (times[next] - times[next - 1]);
  return interpolate(poses[next - 1], poses[next], share);
}

Animation read_run(const fs::path& folder) {
  const fs::path info = folder / "run.json";
  std::error_code ignored;
  if (!fs::exists(info, ignored)) {
    fail_input(fmt::format("{}: has no run.json; give a folder that `pliant run` made", folder.string()));
  }
  const EarlierRun run = read_earlier_run(info);
  if (run.format == "none") {
    fail_input(fmt::format("{}: the run has no frames; run the scene with --format npy", info.string()));
  }
  const fs::path mesh_path = folder / "mesh.obj";
  const Mesh mesh = read_mesh(mesh_path);
  const bool is_array = frames_name(run.format).find('*') == std::string::npos;
  PointCache cache = is_array ? PointCache::read(folder / frames_name(run.format))
                              : read_mesh_frames(folder, run, mesh.vertex_count());
  check_frames(folder / frames_name(run.format), run, cache);
  if (cache.vertex_count() != mesh.vertex_count()) {
    fail_input(fmt::format("{}: has {} vertices, but the frames {}; run the scene again", mesh_path.string(),
                           mesh.vertex_count(), cache.vertex_count()));
  }
  cache.set_times(times_of_run(folder, run, cache.frame_count()));
  std::vector<Real> times = all_times(cache);
  return {run.scene, split_mesh(mesh, run.bodies, mesh_path.string()), std::move(cache), std::move(times)};
}

Animation animate(Mesh mesh, std::string name, PointCache cache) {
  if (cache.vertex_count() != mesh.vertex_count()) {
    fail_input(fmt::format("{}: the mesh has {} vertices, but the cache {}; give the mesh that the cache was made with",
                           name, mesh.vertex_count(), cache.vertex_count()));
  }
  std::vector<Real> times = all_times(cache);
  std::vector<Body> bodies = {{name, std::move(mesh), 0}};
  return {std::move(name), std::move(bodies), std::move(cache), std::move(times)};
}

Animation animate(std::string name, std::span<const Body> bodies, PointCache cache) {
  std::vector<BodyRange> ranges;
  Index vertices = 0;
  for (const Body& body : bodies) {
    ranges.push_back({body.name, body.first_vertex, body.mesh.vertex_count()});
    vertices += body.mesh.vertex_count();
  }
  if (cache.vertex_count() != vertices) {
    fail_input(fmt::format("{}: the bodies have {} vertices, but the cache {}", name, vertices, cache.vertex_count()));
  }
  Mesh mesh = one_mesh_of_run(bodies);
  cache.frame(0, mesh.vertices);
  mesh.faces = visible_faces(mesh);
  if (mesh.triangles.empty()) mesh.triangles = cut_into_triangles(mesh.faces);
  mesh.tetrahedra.clear();
  std::vector<Real> times = all_times(cache);
  std::vector<Body> parts = split_mesh(mesh, ranges, name);
  return {std::move(name), std::move(parts), std::move(cache), std::move(times)};
}

Animation animate(std::string name, PointCache cache) {
  std::vector<Real> times = all_times(cache);
  return {std::move(name), {}, std::move(cache), std::move(times)};
}

PointCache place(PointCache cache, const ImportOptions& options) {
  check_options("point cache", options);
  if (options.scale == 1 && options.up == UpAxis::z) return cache;
  Mat3 turn = Mat3::Identity();
  if (options.up == UpAxis::y) turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  if (options.up == UpAxis::x) turn << 0, 0, -1, 0, 1, 0, 1, 0, 0;
  const Mat3 placement = options.scale * turn;
  std::vector<Positions> frames(static_cast<std::size_t>(cache.frame_count()));
  Positions positions;
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    cache.frame(static_cast<std::int64_t>(frame), positions);
    frames[frame] = positions * placement.transpose();
  }
  return PointCache::from_frames(frames, all_times(cache));
}

Animation still(Mesh mesh, std::string name) {
  PointCache cache = PointCache::from_frames(std::span(&mesh.vertices, 1), {0});
  return animate(std::move(mesh), std::move(name), std::move(cache));
}

void keep_body(Animation& animation, std::string_view name) {
  const auto body = std::ranges::find(animation.bodies, name, &Body::name);
  if (body == animation.bodies.end()) {
    std::vector<std::string_view> names;
    for (const Body& other : animation.bodies) names.emplace_back(other.name);
    fail_input(fmt::format("{}: no body of this name; there are: {}", name, fmt::join(names, ", ")));
  }
  std::vector<Positions> frames(static_cast<std::size_t>(animation.cache.frame_count()));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    Positions all;
    animation.cache.frame(static_cast<std::int64_t>(i), all);
    frames[i] = all.middleRows(body->first_vertex, body->mesh.vertex_count());
  }
  animation.cache = PointCache::from_frames(frames, all_times(animation.cache));
  Body kept = std::move(*body);
  kept.first_vertex = 0;
  animation.name = kept.name;
  animation.bodies.clear();
  animation.bodies.push_back(std::move(kept));
}

void keep_frames(Animation& animation, const FrameRange& range) {
  const auto count = std::ssize(animation.times);
  const auto resolve = [&](std::int64_t frame) {
    if (frame < -count || frame >= count) {
      fail_input(fmt::format("frame {} is out of range, since there are {}; give one from 0 to {}, or from -{} to -1",
                             frame, count, count - 1, count));
    }
    return frame < 0 ? count + frame : frame;
  };
  const std::int64_t first = resolve(range.first);
  const std::int64_t last = resolve(range.last);
  if (range.step < 1 || last < first) {
    fail_input(fmt::format("frames {}:{}:{} select nothing; give a first one before the last one, and a step from 1 up",
                           range.first, range.last, range.step));
  }
  std::vector<Real> kept;
  for (std::int64_t frame = first; frame <= last; frame += std::min<std::int64_t>(range.step, count)) {
    kept.push_back(animation.times[static_cast<std::size_t>(frame)]);
  }
  animation.times = std::move(kept);
}

void keep_time(Animation& animation, Real time) {
  const Real first = animation.times.front();
  const Real last = animation.times.back();
  const Real slack = 1e-9 * (last - first);
  if (!(time >= first - slack && time <= last + slack)) {
    fail_input(fmt::format("{} s is out of range; give a time from {} to {} s", time, first, last));
  }
  animation.times = {std::clamp(time, first, last)};
}

void resample(Animation& animation, Real frames_per_second) {
  constexpr Real max_count = 1e6;
  const Real first = animation.times.front();
  const Real last = animation.times.back();
  const Real intervals = std::floor((last - first) * frames_per_second * (1 + 1e-9));
  if (!(frames_per_second > 0) || !(intervals < max_count)) {
    fail_input(
        fmt::format("{} frames per second are not possible for {} s; give a number greater than 0 that makes at "
                    "most a million frames",
                    frames_per_second, last - first));
  }
  std::vector<Real> times;
  for (Real i = 0; i <= intervals; ++i) times.push_back(std::min(first + i / frames_per_second, last));
  animation.times = std::move(times);
}

Real frame_rate(const std::vector<Real>& times) {
  constexpr Real rate_of_one_frame = 24;
  constexpr Real rounding = 1e-6;
  if (times.size() < 2) return rate_of_one_frame;
  const Real interval = (times.back() - times.front()) / static_cast<Real>(times.size() - 1);
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (std::abs(times[i] - times.front() - static_cast<Real>(i) * interval) > 1e-3 * interval) return 0;
  }
  const Real rate = 1 / interval;
  const Real whole = std::round(rate);
  return std::abs(rate - whole) <= rounding * rate ? whole : rate;
}

}  // namespace pliant
