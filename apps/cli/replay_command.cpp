// pliant replay: does a recorded session again, and says whether it comes out the same.
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "commands.h"
#include "number_option.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "progress.h"
#include "session_film.h"
#include "system/interrupts.h"
#include "terminal.h"

namespace pliant_cli {
namespace {

namespace fs = std::filesystem;

struct ReplayArguments {
  fs::path file;                         ///< of the session
  std::optional<pliant::Index> threads;  ///< none: as the session had them
  bool quiet = false;                    ///< print warnings and errors only
};

/// False when it was interrupted.
bool run_to_end(pliant_viewer::Session& session, const ReplayArguments& arguments) {
  Progress progress(0, session.replayed().wanted_steps,
                    arguments.quiet ? Progress::Show::never : Progress::Show::on_terminal);
  session.set_stop(pliant_system::waits_no_longer);
  while (session.is_replaying()) {
    if (pliant_system::was_interrupted()) return false;
    try {
      const double residual = replay_step(session, arguments.file).residual;
      progress.update(session.replayed().steps, residual);
    } catch (const pliant::Error& error) {
      if (error.kind() == pliant::ErrorKind::interrupted) return false;
      throw;
    }
  }
  return true;
}

int replay(const ReplayArguments& arguments) {
  pliant_viewer::SessionRecord record = pliant_viewer::read_session_record(arguments.file);
  pliant_viewer::Session session([make = scene_maker_of(record, arguments.file), threads = arguments.threads] {
    pliant::Scene scene = make();
    pliant::SolverSettings settings = scene.simulation.settings();
    settings.threads = threads.value_or(settings.threads);
    scene.simulation.set_settings(settings);
    return scene;
  });
  pliant_system::catch_interrupts();
  const std::size_t actions = record.actions.size();
  const std::string scene = record.scene;
  session.replay(std::move(record));
  const auto begin = std::chrono::steady_clock::now();
  if (!run_to_end(session, arguments)) {
    print_to_stderr("interrupted: the session was not done again to its end\n");
    return exit_interrupted;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const pliant_viewer::ReplayReport& report = session.replayed();
  if (!arguments.quiet) {
    fmt::print("{}: {} steps and {} actions in {:.3g} s", pliant::printable(scene), report.steps, actions, seconds);
    fmt::print("{}\n", report.differs_from ? "" : "; the same bits as when it was recorded");
  }
  if (!report.differs_from) return 0;
  print_to_stderr("error: " + difference_text(*report.differs_from) + "\n");
  return exit_differs;
}

}  // namespace

void add_replay_command(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand(
      "replay", "Do a session again that the window has recorded; check that it has the same bits");
  const auto arguments = std::make_shared<ReplayArguments>();
  command->add_option("file", arguments->file, "What Ctrl + R in the window has saved")
      ->type_name("FILE.session")
      ->required();
  add_number(*command, "--threads", arguments->threads,
             "Number of threads at most, 0: one for each processor; results do not depend on it");
  command->add_flag("--quiet", arguments->quiet, "Print warnings and errors only");
  command->footer(
      "`pliant view FILE.session` shows it in the window, and `pliant render FILE.session` makes a film of it.\n"
      "Example:\n  pliant replay curtain_wind-1.session");
  command->callback([arguments, &exit_code] { exit_code = replay(*arguments); });
}

}  // namespace pliant_cli
