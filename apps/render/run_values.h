#pragma once
// What pictures show of a recorded run by color, as numbers of its vertices for other programs.
#include <optional>

#include "pliant_io/export/export.h"
#include "pliant_io/scene/scene.h"
#include "render/render_mesh.h"

namespace pliant_render {

/// Gives the bodies of a run the tetrahedra that they have in its scene; a run records their surfaces alone.
/// @throws pliant::Error (input): other bodies, or other counts of their vertices
void take_tetrahedra(pliant::Animation& animation, const pliant::Simulation& simulation);

/// The values of the vertices in the frames of an animation: "velocity" [m/s], "stretch" (a fraction) and, where the
/// scene is known, "energy" [J].
class RunValues {
 public:
  /// `scene` is what the run was made from, as it was at the start. The animation must outlive this.
  /// @throws pliant::Error (input): a body that the scene has not
  RunValues(const pliant::Animation& animation, std::optional<pliant::Scene> scene);

  /// Of a frame, one after the other. A velocity is from the recorded frame before, zero in the first; stretch against
  /// the first recorded frame; energy as the scene's constraints have it there, with the targets and stiffnesses that
  /// events and motions gave them.
  /// @throws pliant::Error (input): an event that does not act as it did
  std::vector<pliant::VertexValues> at(std::size_t frame);

 private:
  void place_bodies(pliant::Real time);
  void freeze_shapes();
  std::vector<float> energies(pliant::Real time);
  std::vector<float> velocities(pliant::Real time, const pliant::Positions& positions) const;

  const pliant::Animation& animation_;
  std::optional<pliant::Scene> scene_;
  Index first_vertex_ = 0;  ///< of the scene's, where the animation has one body of it
  pliant::State clock_;     ///< step and time alone
  RenderMesh render_mesh_;
};

}  // namespace pliant_render
