#pragma once
#include <filesystem>
#include <functional>

#include "render/clip.h"
#include "viewer/session.h"

namespace pliant_cli {

/// What is drawn of a recorded session from its last restart on, done again. `prepare` sees the scene first, to change
/// its view, and says how many steps are from frame to frame; `go_on` gets the step and how many there are, and ends
/// the clip by returning false. Says on stderr where the replay differs.
/// @throws pliant::Error (input): no such session, or one that its scene does not fit; see clip_from_scene.
pliant_render::Clip clip_from_session(const std::filesystem::path& file,
                                      const std::function<std::int64_t(pliant::Scene&)>& prepare,
                                      const std::function<bool(std::int64_t, std::int64_t)>& go_on);

/// How far a session is, in steps from its last restart on.
struct SessionMoment {
  std::int64_t since = 0, steps = 0;
  bool is_last() const { return since == steps; }
};

/// Does a recorded session again. `prepare` sees the scene first; `visit` each state from the last restart on, at
/// least one; `go_on` gets the step and how many there are, and ends it by returning false.
struct SessionVisitor {
  std::function<void(pliant::Scene&)> prepare;
  std::function<bool(std::int64_t step, std::int64_t steps)> go_on;
  std::function<void(pliant_viewer::Session& session, const SessionMoment& moment)> visit;
};
/// Says on stderr where the replay differs. @throws pliant::Error (input), as clip_from_session
void visit_session(const std::filesystem::path& file, const SessionVisitor& visitor);

/// What a recorded session shows from its last restart on, every step a frame, with its colliders where they were.
/// @throws pliant::Error (input), as clip_from_session
struct SessionAnimation {
  pliant::Animation animation;
  pliant::Scene end;  ///< how the session left it, which has what its bodies look like
};
SessionAnimation animation_of_session(const std::filesystem::path& file);

/// Takes a step of a replay. @throws as Session::step does, naming the file
pliant::StepReport replay_step(pliant_viewer::Session& session, const std::filesystem::path& file);

/// From which step on a replay differs from what was recorded, and why that may be.
std::string difference_text(std::int64_t step);

}  // namespace pliant_cli
