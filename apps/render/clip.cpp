#include "render/clip.h"

#include <algorithm>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "render/choose_direction.h"
#include "render/outline.h"
#include "render/run_replay.h"
#include "render/scalar_fields.h"

namespace pliant_render {
namespace {

using pliant::ColorBy;
using pliant::Real;

constexpr std::int64_t most_bytes = std::int64_t{4} << 30U;

bool is_same(const RunAnnotations::Entry& a, const RunAnnotations::Entry& b) {
  if (a.markers != b.markers || a.held != b.held || a.wind.has_value() != b.wind.has_value()) return false;
  const auto is_alike = [](const DrawnCollider& one, const DrawnCollider& other) {
    return one.number == other.number && one.surface == other.surface && one.pose == other.pose;
  };
  if (!std::ranges::equal(a.colliders, b.colliders, is_alike)) return false;
  return !a.wind || (a.wind->velocity == b.wind->velocity && a.wind->text == b.wind->text);
}

/// Of frames that are between two recorded ones: colliders that both have are on their way, as the bodies are.
std::vector<DrawnCollider> between(std::vector<DrawnCollider> colliders, const std::vector<DrawnCollider>& next,
                                   Real share) {
  for (DrawnCollider& each : colliders) {
    const auto found = std::ranges::find(next, each.number, &DrawnCollider::number);
    if (found != next.end()) each.pose = interpolate(each.pose, found->pose, share);
  }
  return colliders;
}

/// From the frames of a cache to other times: pins and wind are those of the frame before.
RunAnnotations at_times(RunAnnotations of_cache, const pliant::PointCache& cache, const std::vector<Real>& times) {
  constexpr Real rounding = 1e-6;  // of the time from frame to frame
  RunAnnotations result{std::move(of_cache.entries), {}, std::move(of_cache.looks)};
  std::int64_t frame = 0;
  for (const Real time : times) {
    Real share = 0;
    for (; frame + 1 < cache.frame_count(); ++frame) {
      share = (time - cache.time(frame)) / (cache.time(frame + 1) - cache.time(frame));
      if (share < 1 - rounding) break;
      share = 0;
    }
    std::size_t entry = of_cache.entry_of_frame[static_cast<std::size_t>(frame)];
    if (share > rounding) {
      const std::size_t next = of_cache.entry_of_frame[static_cast<std::size_t>(frame) + 1];
      RunAnnotations::Entry here = result.entries[entry];
      here.colliders = between(std::move(here.colliders), result.entries[next].colliders, share);
      if (!is_same(here, result.entries[entry])) {
        entry = result.entries.size();
        result.entries.push_back(std::move(here));
      }
    }
    result.entry_of_frame.push_back(entry);
  }
  return result;
}

}  // namespace

void check_clip_size(std::int64_t frames, Index vertices) {
  const auto bytes = static_cast<std::int64_t>(sizeof(Vec3f) + sizeof(float));
  if (vertices == 0 || frames <= most_bytes / bytes / vertices) return;
  pliant::fail_input(
      fmt::format("{} frames of {} vertices would take {} GB; film fewer steps, or fewer frames a second", frames,
                  vertices, frames / 1'000'000 * vertices * bytes / 1000));
}

Clip clip_from_scene(pliant::Scene& scene, std::int64_t every, const std::function<bool(std::int64_t)>& go_on) {
  Clip clip{make_render_mesh(scene), scene.view, {}};
  check_clip_size((scene.steps - scene.simulation.state().step) / every + 2, clip.render_mesh.vertex_count);
  ColliderSurfaces surfaces;
  const auto keep = [&] {
    clip.frames.push_back(capture_frame(scene.simulation, clip.render_mesh, scene.view.color, surfaces));
  };
  keep();
  for (std::int64_t step = scene.simulation.state().step; step < scene.steps && go_on(step);) {
    scene.step();
    if (++step % every == 0 || step == scene.steps) keep();
  }
  return clip;
}

RunAnnotations annotate_run(pliant::Scene scene, const pliant::Animation& animation) {
  const pliant::Simulation& simulation = scene.simulation;
  if (simulation.state().vertex_count() != animation.cache.vertex_count()) {
    pliant::fail_input(fmt::format("the scene has {} vertices, and the run {}", simulation.state().vertex_count(),
                                   animation.cache.vertex_count()));
  }
  RunAnnotations annotations;
  annotations.looks = body_looks(simulation.bodies(), scene.appearances, scene.materials, scene.collider_appearances);
  ColliderSurfaces surfaces;
  replay(scene, animation.cache, [&](std::int64_t step) {
    RunAnnotations::Entry entry{find_markers(simulation, step), find_wind(simulation), surfaces.find(simulation),
                                find_held(simulation)};
    if (annotations.entries.empty() || !is_same(annotations.entries.back(), entry)) {
      annotations.entries.push_back(std::move(entry));
    }
    annotations.entry_of_frame.push_back(annotations.entries.size() - 1);
  });
  return at_times(std::move(annotations), animation.cache, animation.times);
}

RunFrames::RunFrames(pliant::Animation animation, RunAnnotations annotations)
    : animation_(std::move(animation)), annotations_(std::move(annotations)) {
  if (animation_.bodies.empty()) {
    pliant::fail_input(animation_.name + ": only points are known; a picture needs their mesh");
  }
  const std::vector<std::size_t>& entries = annotations_.entry_of_frame;
  render_mesh_ = make_render_mesh(animation_.bodies, entries.empty() ? std::span<const std::uint32_t>()
                                                                     : annotations_.entries[entries.front()].held);
  render_mesh_.looks.colliders = annotations_.looks.colliders;
  if (annotations_.looks.vertices.size() == static_cast<std::size_t>(render_mesh_.vertex_count)) {
    render_mesh_.looks = std::move(annotations_.looks);
  }
  pliant::Positions x;
  animation_.cache.sample(animation_.times.front(), x);
  rest_at(render_mesh_, x);
}

ClipFrame RunFrames::frame(std::size_t i, ColorBy color) const {
  check_known_of_runs(color);
  pliant::Positions x;
  animation_.cache.sample(time(i), x);
  ClipFrame frame{time(i), {to_floats(x), {}, {}, {}, {}}, {}};
  if (i < annotations_.entry_of_frame.size()) {
    const RunAnnotations::Entry& entry = annotations_.entries[annotations_.entry_of_frame[i]];
    frame.content.markers = entry.markers;
    frame.content.colliders = entry.colliders;
    frame.content.held = entry.held;
    frame.wind = entry.wind;
  }
  if (color == ColorBy::stretch) frame.content.values = vertex_stretch(render_mesh_, frame.content.positions);
  if (color == ColorBy::speed) {
    pliant::Positions velocities = pliant::Positions::Zero(x.rows(), 3);
    if (i > 0 && time(i) > time(i - 1)) {
      pliant::Positions before;
      animation_.cache.sample(time(i - 1), before);
      velocities = (x - before) / (time(i) - time(i - 1));
    }
    frame.content.values = vertex_speed(velocities);
  }
  return frame;
}

Clip clip_from_animation(pliant::Animation animation, const pliant::ViewSettings& appearance,
                         RunAnnotations annotations) {
  const RunFrames frames(std::move(animation), std::move(annotations));
  Clip clip{frames.render_mesh(), appearance, {}};
  check_clip_size(static_cast<std::int64_t>(frames.count()), clip.render_mesh.vertex_count);
  for (std::size_t i = 0; i < frames.count(); ++i) clip.frames.push_back(frames.frame(i, appearance.color));
  return clip;
}

Bounds bounds_of(const Clip& clip) {
  Outline outline;
  for (const ClipFrame& frame : clip.frames) outline.add(frame.content, clip.appearance);
  return outline.bounds();
}

pliant::Camera camera_of(const Clip& clip, const Bounds& bounds, const std::array<pliant::Index, 2>& size) {
  constexpr std::size_t most = 5;
  std::vector<FrameContent> frames;
  const std::size_t count = std::min(most, clip.frames.size());
  for (std::size_t i = 0; i < count; ++i) {
    const ClipFrame& frame = clip.frames[count == 1 ? 0 : i * (clip.frames.size() - 1) / (count - 1)];
    frames.push_back(visible_part(frame.content, clip.appearance));
  }
  const float aspect = static_cast<float>(size[0]) / static_cast<float>(size[1]);
  return choose_direction(clip.appearance.camera, clip.render_mesh, frames, bounds, aspect);
}

float ground_height(const Clip& clip, const Bounds& bounds) {
  if (clip.appearance.ground_height) return static_cast<float>(*clip.appearance.ground_height);
  return bounds.is_empty() ? 0 : bounds.low.z() - 0.03F * bounds.radius();
}

std::array<float, 2> color_range(const Clip& clip) {
  if (clip.appearance.color_range) {
    const auto& given = *clip.appearance.color_range;
    return {static_cast<float>(given[0]), static_cast<float>(given[1])};
  }
  std::vector<float> extremes;
  for (const ClipFrame& frame : clip.frames) {
    const auto [least, most] = std::ranges::minmax_element(frame.content.values);
    if (least == frame.content.values.end()) continue;
    extremes.push_back(*least);
    extremes.push_back(*most);
  }
  return field_range(clip.appearance.color, extremes);
}

}  // namespace pliant_render
