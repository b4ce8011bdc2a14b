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
      "at step {}, or up to {} before it, its bits are others than they were; they are the same by one build of the "
      "program and on processors with the same instructions",
      step, pliant_viewer::SessionLog::checksum_period - 1);
}

namespace {

void take_step(pliant_viewer::Session& session, const std::filesystem::path& file) {
  try {
    session.step();
  } catch (const pliant::Error& error) {
    throw pliant::Error(error.kind(), fmt::format("{}: {}", pliant::printable_place(file.string()), error.what()));
  }
}

}  // namespace

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
    take_step(session, file);
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
