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

/// Takes a step of a replay. @throws as Session::step does, naming the file
pliant::StepReport replay_step(pliant_viewer::Session& session, const std::filesystem::path& file);

/// From which step on a replay differs from what was recorded, and why that may be.
std::string difference_text(std::int64_t step);

}  // namespace pliant_cli
