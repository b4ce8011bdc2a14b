#pragma once
// The frames of a film before any of them is drawn, from a simulated scene or a recorded run. All are kept in memory,
// so that camera, ground and colors suit the whole film.
#include <functional>
#include <optional>
#include <vector>

#include "pliant_io/export/animation.h"
#include "pliant_io/scene/scene.h"
#include "render/capture.h"

namespace pliant_render {

struct Clip {
  RenderMesh render_mesh;           ///< what all frames share
  pliant::ViewSettings appearance;  ///< size, camera, colors and light
  std::vector<ClipFrame> frames;    ///< by time, ascending
};

/// @throws pliant::Error (input) if so many frames would take more than 4 GB.
void check_clip_size(std::int64_t frames, pliant::Index vertices);

/// Simulates the scene to its last step and keeps the start, every n-th step and the last; `go_on` gets the step and
/// ends the clip by returning false.
/// @throws pliant::Error (input) if the frames would take more than 4 GB.
Clip clip_from_scene(pliant::Scene& scene, std::int64_t every, const std::function<bool(std::int64_t)>& go_on);

/// What is drawn of pins, test forces, wind and colliders, frame by frame of a run; equal neighbors stand once.
struct RunAnnotations {
  struct Entry {
    std::vector<std::uint32_t> markers;  ///< vertices that are pinned or under a test force, ascending
    std::optional<WindAnnotation> wind;
    std::vector<DrawnCollider> colliders;
    std::vector<std::uint32_t> held;  ///< vertices of bodies that are held as a whole, ascending
  };
  std::vector<Entry> entries;
  std::vector<std::size_t> entry_of_frame;  ///< empty where nothing is known
  BodyLooks looks;
};

/// Those at the times of an animation, by the scene that its run was made from, as it was at the start (replay).
/// Between two recorded frames colliders are on the way from one to the other, and all else is as in the first of them.
/// @throws pliant::Error (input): another count of vertices, an event that does not act as it did
RunAnnotations annotate_run(pliant::Scene scene, const pliant::Animation& animation);

/// Frames of a run, one at a time, in any order. Stretch is against the first frame, speed from frame to frame.
class RunFrames {
 public:
  /// @throws pliant::Error (input): points without a mesh
  explicit RunFrames(pliant::Animation animation, RunAnnotations annotations = {});

  const RenderMesh& render_mesh() const { return render_mesh_; }
  std::size_t count() const { return animation_.times.size(); }
  pliant::Real time(std::size_t i) const { return animation_.times[i]; }
  const std::string& name() const { return animation_.name; }
  /// @throws pliant::Error (input): colors by energy, which need the scene
  ClipFrame frame(std::size_t i, pliant::ColorBy color) const;

 private:
  pliant::Animation animation_;
  RunAnnotations annotations_;
  RenderMesh render_mesh_;
};

/// The frames of a run at the times that the animation has. Stretch is against the first frame, speed from frame to
/// frame. @throws Error (input): colors by energy, which needs the scene; points without a mesh.
Clip clip_from_animation(pliant::Animation animation, const pliant::ViewSettings& appearance,
                         RunAnnotations annotations = {});

/// The box around all frames, with its outline.
Bounds bounds_of(const Clip& clip);
/// The camera for a picture of this size, its direction chosen by frames all over the clip where the scene leaves it
/// open.
pliant::Camera camera_of(const Clip& clip, const Bounds& bounds, const std::array<pliant::Index, 2>& size);
/// The height of the ground [m]: what the scene says, else a little below everything.
float ground_height(const Clip& clip, const Bounds& bounds);
/// The range of the colors: what the scene says, else the range of the values of all frames. Stretch is a fraction.
std::array<float, 2> color_range(const Clip& clip);

}  // namespace pliant_render
