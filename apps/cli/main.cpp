#include <algorithm>
#include <cstdio>
#include <new>
#include <string>

#include <fmt/format.h>

#include "commands.h"
#include "pliant/core/error.h"
#include "pliant/core/version.h"
#include "terminal.h"

namespace {

constexpr std::string_view help_footer = R"(Examples:
  pliant scenes                                  lists the built-in scenes
  pliant run curtain_wind --out out/curtain      simulates one of them
  pliant run my_scene.json --format obj          simulates your own, one OBJ file a frame

Exit codes: 0 done, 2 bad input, 3 diverged, 4 output could not be written, 130 interrupted.)";

int print_error(std::string message, pliant::ErrorKind kind) {
  std::ranges::replace(message, '\n', ' ');
  pliant_cli::print_to_stderr("pliant: error: " + message + "\n");
  return static_cast<int>(kind);
}

/// What went to standard output may still be lost, to a full disk for one.
void flush_output() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw pliant::Error(pliant::ErrorKind::output,
                      "the standard output cannot be written; make room, or send it elsewhere");
}

int run_program(int argc, char** argv) {
  CLI::App program{"Projective Dynamics of cloth, ropes and soft bodies", "pliant"};
  program.set_version_flag("--version", fmt::format("pliant {} ({})", pliant::version, pliant::compiler));
  program.footer(std::string(help_footer));
  program.require_subcommand(1);
  int exit_code = 0;
  pliant_cli::add_run_command(program, exit_code);
  pliant_cli::add_scenes_command(program);
  pliant_cli::add_info_command(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) {
      return print_error(fmt::format("{}; see pliant --help", error.what()), pliant::ErrorKind::input);
    }
    program.exit(error);  // prints the help or the version
  }
  flush_output();
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  pliant_cli::guard_streams();
  try {
    return run_program(argc, argv);
  } catch (const pliant::Error& error) {
    return print_error(error.what(), error.kind());
  } catch (const std::bad_alloc&) {
    return print_error("out of memory; use a smaller mesh or a machine with more", pliant::ErrorKind::input);
  } catch (const std::exception& error) {
    return print_error(error.what(), pliant::ErrorKind::input);
  }
}
