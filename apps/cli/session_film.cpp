// A recorded session to frames, drawn or exported.
#include "session_film.h"

#include <exception>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "render/collider_tracks.h"
#include "system/interrupts.h"
#include "terminal.h"

namespace pliant_cli {
namespace {

/// @throws pliant::Error (input)
void check_size(const std::filesystem::path& file, std::int64_t frames, pliant::Index vertices) {
  constexpr std::int64_t most_bytes = std::int64_t{4} << 30, frame_bytes = sizeof(pliant_render::Vec3f);
  if (vertices == 0 || frames <= most_bytes / frame_bytes / vertices) return;
  pliant::fail_input(fmt::format(
      "{}: its {} frames of {} vertices would take more than 4 GiB; record a shorter session, from a restart on",
      pliant::printable_place(file.string()), frames, vertices));
}

}  // namespace

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

void visit_session(const std::filesystem::path& file, const SessionVisitor& visitor) {
  pliant_viewer::SessionRecord record = pliant_viewer::read_session_record(file);
  pliant_viewer::Session session([&, make = scene_maker_of(record, file)] {
    pliant::Scene scene = make();
    if (visitor.prepare) visitor.prepare(scene);
    return scene;
  });
  session.set_stop(pliant_system::waits_no_longer);
  const std::int64_t first = record.last_start(), steps = record.steps;
  bool has_visited = false;
  const auto visit = [&](std::int64_t since) {
    visitor.visit(session, {since, steps - first});
    has_visited = true;
  };
  // What was done before the first step belongs to its start; a restart comes with the step that follows it.
  std::exception_ptr failure;  // which a session would take for one of the step
  pliant_viewer::ProgramHooks hooks;
  hooks.before_step = [&](pliant::Simulation&) {
    if (first != 0 || has_visited) return;
    try {
      visit(0);
    } catch (...) {
      failure = std::current_exception();
    }
  };
  session.set_hooks(std::move(hooks));
  session.replay(std::move(record));
  for (std::int64_t step = 0; session.is_replaying() && visitor.go_on(step, steps);) {
    replay_step(session, file);
    if (failure) std::rethrow_exception(failure);
    ++step;
    if (step > first) visit(step - first);
  }
  if (!has_visited) visit(0);
  if (const auto differs_from = session.replayed().differs_from) {
    print_to_stderr("note: " + difference_text(*differs_from) + "\n");
  }
}

pliant_render::Clip clip_from_session(const std::filesystem::path& file,
                                      const std::function<std::int64_t(pliant::Scene&)>& prepare,
                                      const std::function<bool(std::int64_t, std::int64_t)>& go_on) {
  std::int64_t every = 1;
  pliant_render::ColliderSurfaces surfaces;
  std::optional<pliant_render::Clip> clip;
  const auto keep = [&](pliant_viewer::Session& session, const SessionMoment& moment) {
    if (clip && moment.since % every != 0 && !moment.is_last()) return;
    if (!clip) {
      clip = pliant_render::Clip{pliant_render::make_render_mesh(session.scene()), session.scene().view, {}};
      pliant_render::check_clip_size(moment.steps / every + 2, clip->render_mesh.vertex_count);
    }
    clip->frames.push_back(capture_frame(session.simulation(), clip->render_mesh, clip->appearance.color, surfaces));
  };
  visit_session(file, {[&](pliant::Scene& scene) { every = prepare(scene); }, go_on, keep});
  return std::move(*clip);
}

SessionAnimation animation_of_session(const std::filesystem::path& file) {
  std::string bytes;
  std::vector<pliant::Real> times;
  std::vector<pliant::Body> bodies;
  std::optional<pliant_render::ColliderTracks> colliders;
  std::optional<pliant::Scene> end;
  const auto go_on = [](std::int64_t step, std::int64_t steps) {
    if (step % 16 == 0 && has_error_terminal()) {
      print_to_stderr(fmt::format("\r\x1b[Ksimulating: step {} of {}", step, steps));
    }
    return true;
  };
  const auto keep = [&](pliant_viewer::Session& session, const SessionMoment& moment) {
    const pliant::Simulation& simulation = session.simulation();
    if (!colliders) {
      check_size(file, moment.steps + 1, simulation.state().vertex_count());
      colliders.emplace(simulation);
      bodies = simulation.bodies();
    }
    const std::vector<pliant_render::Vec3f> positions = pliant_render::to_floats(simulation.state().positions);
    const auto* const numbers = reinterpret_cast<const char*>(positions.data());  // NOLINT: as a cache holds them
    bytes.append(numbers, positions.size() * sizeof(pliant_render::Vec3f));
    times.push_back(simulation.state().time);
    colliders->add_frame(simulation, simulation.state().time);
    if (moment.is_last()) end = session.close();
  };
  visit_session(file, {{}, go_on, keep});
  if (has_error_terminal()) print_to_stderr("\r\x1b[K");
  const auto count = static_cast<pliant::Index>(end->simulation.state().vertex_count());
  pliant::PointCache cache(std::move(bytes), {0, pliant::PointCache::Scalar::float32, count}, std::move(times));
  SessionAnimation made{pliant::animate(file.stem().string(), bodies, std::move(cache)), std::move(*end)};
  made.animation.colliders = colliders->take();
  return made;
}

}  // namespace pliant_cli
