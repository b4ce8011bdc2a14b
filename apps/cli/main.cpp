#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "commands.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant/core/version.h"
#include "pliant_io/scene/nearest_names.h"
#include "terminal.h"

namespace {

constexpr std::string_view help_footer = R"(Examples:
  pliant scenes                                  lists the built-in scenes
  pliant run curtain_wind --out out/curtain      simulates one of them
  pliant check my_scene.json                     says what is in your own, and what is wrong with it
  pliant run my_scene.json --format obj          simulates it, one OBJ file a frame
  pliant resume out/curtain --steps 900          goes on with a run that ended or was stopped
  pliant view curtain_wind                       opens a window in which one can pull at it
  pliant render curtain_wind --out curtain.mp4   makes a film, without a display
  pliant convert out/curtain curtain.glb         exports a run as an animation
  pliant sweep curtain --vary settings.iterations=5,10,20 --out out/sweep    runs all of these, with a table and plots
  pliant experiment all --out report             repeats the experiments of the thesis, with figures and verdicts
  pliant info shirt.ply                          says what a mesh is like, and what is wrong with it
  pliant bench                                   says how fast this machine is, part by part

Exit codes: 0 done, 2 bad input, 3 diverged, 4 output could not be written, 130 interrupted.)";

int print_error(std::string_view message, pliant::ErrorKind kind) {
  pliant_cli::print_to_stderr("pliant: error: " + pliant::printable_place(message, pliant_cli::message_limit) + "\n");
  return static_cast<int>(kind);
}

/// What went to standard output may still be lost, to a full disk for one.
void flush_output() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  if (errno == EPIPE) throw std::system_error(EPIPE, std::generic_category());
  throw pliant::Error(pliant::ErrorKind::output,
                      "the standard output cannot be written; make room, or send it elsewhere");
}

/// The library that reads the command line only says that a sub-command is missing.
void refuse_unknown_command(const CLI::App& program, std::string_view first) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  if (first.starts_with('-') || std::ranges::find(names, first) != names.end()) return;
  pliant::fail_input(fmt::format("'{}' is no command; known, the nearest first: {}; see pliant --help",
                                 pliant::printable(first),
                                 pliant::nearest_names_text(first, {names.begin(), names.end()})));
}

int run_program(int argc, char** argv) {
  CLI::App program{"Projective Dynamics of cloth, ropes and soft bodies", "pliant"};
  program.set_version_flag("--version", fmt::format("pliant {} ({})", pliant::version, pliant::compiler));
  program.footer(std::string(help_footer));
  program.require_subcommand(1);
  int exit_code = 0;
  pliant_cli::add_run_command(program, exit_code);
  pliant_cli::add_resume_command(program, exit_code);
  pliant_cli::add_sweep_command(program, exit_code);
  pliant_cli::add_experiment_command(program, exit_code);
  pliant_cli::add_render_command(program, exit_code);
  pliant_cli::add_view_command(program, exit_code);
  pliant_cli::add_check_command(program);
  pliant_cli::add_convert_command(program);
  pliant_cli::add_info_command(program);
  pliant_cli::add_bench_command(program);
  pliant_cli::add_scenes_command(program);
  pliant_cli::add_schema_command(program);
  if (argc > 1) refuse_unknown_command(program, argv[1]);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) {
      return print_error(fmt::format("{}; see pliant --help", pliant::printable(error.what(), 400)),
                         pliant::ErrorKind::input);
    }
    program.exit(error);  // prints the help or the version
  }
  flush_output();
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  pliant_cli::guard_streams();
  pliant_cli::limit_memory();
  try {
    return run_program(argc, argv);
  } catch (const pliant::Error& error) {
    return print_error(error.what(), error.kind());
  } catch (const std::filesystem::filesystem_error& error) {
    return print_error(error.what(), pliant::ErrorKind::input);
  } catch (const std::system_error& error) {                                                // of the standard output
    if (error.code().value() == EPIPE) return static_cast<int>(pliant::ErrorKind::output);  // its reader had enough
    return print_error(error.what(), pliant::ErrorKind::output);
  } catch (const std::bad_alloc&) {
    return print_error("out of memory; use a smaller mesh or a machine with more", pliant::ErrorKind::input);
  } catch (const std::exception& error) {
    return print_error(error.what(), pliant::ErrorKind::input);
  }
}
