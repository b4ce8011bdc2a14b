// A recorded session to frames.
#include "session_film.h"

#include <fmt/format.h>

#include "interrupts.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "terminal.h"

namespace pliant_cli {

std::string difference_text(std::int64_t step) {
  return fmt::format(
      "the replay differs from the recording, from step {} on or a little before; bits are compared every {} steps, "
      "and "
      "only the same build of the program, on a processor with the same instructions, repeats them",
      step, pliant_viewer::SessionLog::checksum_period);
}

pliant::StepReport replay_step(pliant_viewer::Session& session, const std::filesystem::path& file) {
  try {
    return session.step();
  } catch (const pliant::Error& error) {
    throw pliant::Error(error.kind(), fmt::format("{}: {}", pliant::printable_place(file.string()), error.what()));
  }
}

pliant_render::Clip clip_from_session(const std::filesystem::path& file,
                                      const std::function<std::int64_t(pliant::Scene&)>& prepare,
                                      const std::function<bool(std::int64_t, std::int64_t)>& go_on) {
  pliant_viewer::SessionRecord record = pliant_viewer::read_session_record(file);
  std::int64_t every = 1;
  pliant_viewer::Session session([&, make = scene_maker_of(record, file)] {
    pliant::Scene scene = make();
    every = prepare(scene);
    return scene;
  });
  session.set_stop(waits_no_longer);
  const std::int64_t first = record.last_start(), steps = record.steps;
  session.replay(std::move(record));
  pliant_render::ColliderSurfaces surfaces;
  std::optional<pliant_render::Clip> clip;
  const auto keep = [&] {
    if (!clip) {
      clip = pliant_render::Clip{pliant_render::make_render_mesh(session.scene()), session.scene().view, {}};
      pliant_render::check_clip_size((steps - first) / every + 2, clip->render_mesh.vertex_count);
    }
    clip->frames.push_back(capture_frame(session.simulation(), clip->render_mesh, clip->appearance.color, surfaces));
  };
  // The restart itself comes with the step that follows it.
  if (first == 0) keep();
  for (std::int64_t step = 0; session.is_replaying() && go_on(step, steps);) {
    replay_step(session, file);
    ++step;
    if (step > first && ((step - first) % every == 0 || step == steps || !clip)) keep();
  }
  if (!clip) keep();
  if (const auto differs_from = session.replayed().differs_from) {
    print_to_stderr("note: " + difference_text(*differs_from) + "\n");
  }
  return std::move(*clip);
}

}  // namespace pliant_cli
