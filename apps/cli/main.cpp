#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <new>
#include <span>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "choice_option.h"
#include "commands.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant/core/version.h"
#include "pliant_io/scene/nearest_names.h"
#include "program_text.h"
#include "system/memory.h"
#include "system/streams.h"
#include "terminal.h"

namespace {

std::string help_footer() {
  std::size_t width = 0;
  constexpr std::size_t widest = 48;
  const auto examples = pliant_cli::program_examples();
  for (const auto& example : examples) {
    if (example.command.size() <= widest) width = std::max(width, example.command.size());
  }
  std::string text = "Examples:\n";
  for (const auto& [command, meaning] : examples) {
    text += fmt::format("  {:<{}}  {}\n", command, width, meaning);
  }
  text += "\nExit codes:";
  for (const auto& [code, meaning] : pliant_cli::exit_codes) {
    text += fmt::format("{} {} {}", code == 0 ? "" : ",", code, meaning);
  }
  return text + ".";
}

int print_error(std::string_view message, pliant::ErrorKind kind) {
  pliant_cli::print_to_stderr("pliant: error: " + pliant::printable_place(message, pliant_cli::message_limit) + "\n");
  return static_cast<int>(kind);
}

constexpr std::string_view lost_output = "the standard output cannot be written; make room, or send it elsewhere";

/// What went to standard output may still be lost, to a full disk for one.
void flush_output() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  if (errno == EPIPE) throw std::system_error(EPIPE, std::generic_category());
  throw pliant::Error(pliant::ErrorKind::output, std::string(lost_output));
}

/// Colors are chosen before anything is read, since what is wrong with the rest may be told in them.
void choose_colors(std::span<char*> words) {
  for (std::size_t i = 1; i < words.size() && words[i][0] == '-'; ++i) {
    std::string_view value = words[i];
    if (value == "--ansi" && i + 1 < words.size()) {
      value = words[++i];
    } else if (value.starts_with("--ansi=")) {
      value.remove_prefix(7);
    } else {
      continue;
    }
    constexpr auto names = choice_names(pliant_cli::Ansi{});
    const auto found = std::ranges::find(names, value);
    if (found != names.end()) pliant_cli::choose_ansi(static_cast<pliant_cli::Ansi>(found - names.begin()));
  }
}

/// The library that reads the command line would take the next word for the value.
void refuse_empty_values(std::span<char*> words) {
  for (const std::string_view word : words.subspan(std::min<std::size_t>(1, words.size()))) {
    if (word == "--") return;
    if (word.size() < 4 || !word.starts_with("--") || word.find('=') != word.size() - 1) continue;
    const std::string option = pliant::printable(word.substr(0, word.size() - 1), 60);
    pliant::fail_input(
        fmt::format("{}: its value is missing; put one behind the '=', or leave {} out", option, option));
  }
}

/// The library only says that a sub-command is missing.
void refuse_unknown_command(const pliant_cli::ProgramText& program, std::span<char*> words) {
  std::size_t i = 1;
  while (i < words.size() && words[i][0] == '-') i += std::string_view(words[i]) == "--ansi" ? 2 : 1;
  if (i >= words.size() || std::string_view(words[i]) == "man") return;
  std::vector<std::string_view> names;
  for (const pliant_cli::CommandText& command : program.commands) names.push_back(command.name);
  const std::string_view word = words[i];
  if (std::ranges::find(names, word) != names.end()) return;
  if (std::ranges::find(pliant_cli::study_commands, word) != pliant_cli::study_commands.end()) {
    pliant::fail_input(
        fmt::format("this program was built without '{}'; build all of it: cmake --preset release && "
                    "cmake --build --preset release",
                    word));
  }
  const std::string suggestion = pliant::did_you_mean(word, names);
  pliant::fail_input(fmt::format("unknown command '{}'{}", pliant::printable(word),
                                 suggestion.empty() ? "; see pliant --help" : suggestion));
}

/// What is wrong with a word that nothing takes.
std::string unknown_word_text(const CLI::App& command, const pliant_cli::CommandText& text) {
  const std::vector<std::string> words = command.remaining();
  const auto option = std::ranges::find_if(words, [](const std::string& word) { return word.starts_with('-'); });
  if (option == words.end()) return fmt::format("unexpected argument '{}'", pliant::printable(words.front()));
  std::vector<std::string_view> names;
  for (const pliant_cli::OptionText& known : text.options)
    names.insert(names.end(), known.names.begin(), known.names.end());
  const std::string word = option->substr(0, option->find('='));
  return fmt::format("unknown option '{}'{}", pliant::printable(word), pliant::did_you_mean(word, names));
}

/// The library's refusal in words of this program.
std::string refusal_text(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App* command = &program;
  if (!program.get_subcommands().empty()) command = program.get_subcommands().front();
  const std::string help = command == &program ? "see pliant --help" : "see pliant " + command->get_name() + " --help";
  std::string what = pliant::printable(error.what(), 400);
  const std::string first = what.substr(0, what.find_first_of(": "));
  const std::string name = first.starts_with('-') ? first : "'" + first + "'";
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    what = command == &program ? "no command is given" : name + " is missing";
  } else if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr && what.ends_with(" missing")) {
    what = first + ": its value is missing";
  } else if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr && what.ends_with("flag override")) {
    what = "--" + what.substr(0, what.find(' ')) + " takes no value";
  } else if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && !command->remaining().empty()) {
    what = unknown_word_text(*command, pliant_cli::describe_command(*command));
    if (what.ends_with('?')) return what;
  }
  return what + "; " + help;
}

void add_commands(CLI::App& program, int& exit_code) {
  pliant_cli::add_run_command(program, exit_code);
  pliant_cli::add_resume_command(program, exit_code);
  if constexpr (pliant_cli::has_studies) {
    pliant_cli::add_sweep_command(program, exit_code);
    pliant_cli::add_experiment_command(program, exit_code);
    pliant_cli::add_plot_command(program);
  }
  pliant_cli::add_render_command(program, exit_code);
  pliant_cli::add_view_command(program, exit_code);
  pliant_cli::add_replay_command(program, exit_code);
  pliant_cli::add_check_command(program);
  pliant_cli::add_convert_command(program);
  pliant_cli::add_info_command(program);
  if constexpr (pliant_cli::has_studies) pliant_cli::add_bench_command(program);
  pliant_cli::add_materials_command(program);
  pliant_cli::add_scenes_command(program);
  pliant_cli::add_schema_command(program);
  pliant_cli::add_completion_command(program);
  pliant_cli::add_man_command(program);
}

int run_program(int argc, char** argv) {
  const std::span<char*> words(argv, static_cast<std::size_t>(argc));
  choose_colors(words);
  CLI::App program{"Projective Dynamics of cloth, ropes and soft bodies", "pliant"};
  program.set_version_flag("--version", fmt::format("pliant {} ({})", pliant::version, pliant::compiler));
  program.footer(help_footer());
  program.require_subcommand(1);
  program.option_defaults()->disable_flag_override();
  pliant_cli::Ansi ansi = pliant_cli::Ansi::automatic;  // which choose_colors has seen to
  pliant_cli::add_choice(program, "--ansi", ansi,
                         "Colors of messages: auto (on a terminal, unless NO_COLOR is set), always or never");
  int exit_code = 0;
  add_commands(program, exit_code);
  refuse_unknown_command(pliant_cli::describe_program(program), words);
  refuse_empty_values(words);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) {
      return print_error(refusal_text(program, error), pliant::ErrorKind::input);
    }
    program.exit(error);  // prints the help or the version
  }
  flush_output();
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  pliant_system::guard_streams();
  pliant_system::limit_memory();
  try {
    return run_program(argc, argv);
  } catch (const pliant::Error& error) {
    return print_error(error.what(), error.kind());
  } catch (const std::filesystem::filesystem_error& error) {
    return print_error(error.what(), pliant::ErrorKind::input);
  } catch (const std::system_error& error) {                                                // of the standard output
    if (error.code().value() == EPIPE) return static_cast<int>(pliant::ErrorKind::output);  // its reader had enough
    return print_error(lost_output, pliant::ErrorKind::output);
  } catch (const std::bad_alloc&) {
    return print_error("out of memory; use a smaller mesh or a machine with more", pliant::ErrorKind::input);
  } catch (const std::exception& error) {
    return print_error(error.what(), pliant::ErrorKind::input);
  }
}
