#pragma once
// What is filmed: the frames of a scene as it is simulated, or of a run that was recorded, before any of them is drawn.
// All are kept, so that camera, ground and colors suit the whole film.
#include <functional>
#include <optional>
#include <vector>

#include "pliant_io/export/animation.h"
#include "pliant_io/scene/scene.h"
#include "render/scenery.h"
#include "render/signs.h"

namespace pliant_render {

struct TakeFrame {
  pliant::Real time = 0;  ///< [s]
  FrameContent content;
  std::optional<WindSign> wind;
};

struct Take {
  Scenery scenery;
  pliant::ViewSettings look;
  std::vector<TakeFrame> frames;
};

/// Vertices that positions hold, ascending.
std::vector<std::uint32_t> pinned_vertices(const pliant::Simulation& simulation);

/// A frame of the simulation as it is now.
TakeFrame take_frame(const pliant::Simulation& simulation, const Scenery& scenery, pliant::ColorBy color);

/// Simulates the scene to its last step and keeps the start, every n-th step and the last; `go_on`, told the step, may
/// end it.
/// @throws Error (input) where the frames would take more than 4 GB.
Take take_scene(pliant::Scene& scene, std::int64_t every, const std::function<bool(std::int64_t)>& go_on);

/// Frames of a run, one at a time, in any order. Stretch is against the first frame, speed from frame to frame.
class RunFrames {
 public:
  /// @throws Error (input): points without a mesh
  explicit RunFrames(pliant::Animation animation);

  const Scenery& scenery() const { return scenery_; }
  std::size_t count() const { return animation_.times.size(); }
  pliant::Real time(std::size_t i) const { return animation_.times[i]; }
  const std::string& name() const { return animation_.name; }
  /// @throws Error (input): colors by energy, which needs the scene
  TakeFrame frame(std::size_t i, pliant::ColorBy color) const;

 private:
  pliant::Animation animation_;
  Scenery scenery_;
};

/// The frames of a run at the times that the animation has. Stretch is against the first frame, speed from frame to
/// frame. @throws Error (input): colors by energy, which needs the scene; points without a mesh.
Take take_animation(pliant::Animation animation, const pliant::ViewSettings& look);

/// The box around all frames.
Bounds bounds_of(const Take& take);
/// Of the ground: what the scene says, else a little below everything.
float ground_height(const Take& take);
/// Of the colors: what the scene says, else as the values of all frames have it. Fractions for stretch.
std::array<float, 2> color_range(const Take& take);

}  // namespace pliant_render
