#pragma once
// What the program says of itself, as data: the help, the man page and the completions are made from it.
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): CLI11 calls itself so
class App;
}

namespace pliant_cli {

struct ExitCode {
  int code;
  std::string_view meaning;
};
inline constexpr std::array<ExitCode, 6> exit_codes = {{{0, "done"},
                                                        {2, "bad input"},
                                                        {3, "the simulation diverged"},
                                                        {4, "the output could not be written"},
                                                        {5, "a replay differs from what was recorded"},
                                                        {130, "interrupted"}}};

struct Example {
  std::string_view command;
  std::string_view text;
};
/// What one may try; of commands that this program has.
std::vector<Example> program_examples();

/// An option, or a positional argument.
struct OptionText {
  std::vector<std::string> names;    ///< "--out", "-h"; of an argument its one name
  std::string value;                 ///< "INT", "FILE"; "" for a flag
  std::vector<std::string> choices;  ///< all values there are; none: any
  std::string help;
};

struct CommandText {
  std::string name;
  std::string help;
  std::string footer;
  std::vector<OptionText> arguments;
  std::vector<OptionText> options;
};

struct ProgramText {
  CommandText program;                ///< with the options that stand before a command
  std::vector<CommandText> commands;  ///< those that the help lists, in its order
};
CommandText describe_command(const CLI::App& command);
ProgramText describe_program(const CLI::App& program);

/// The values of an argument that are known by name: built-in scenes, experiments, choices.
std::vector<std::string> known_values(const OptionText& argument);

/// The page in roff, for man(1).
std::string man_page(const ProgramText& program);

/// The script that completes command lines in a shell: bash, zsh or fish.
std::string bash_completion(const ProgramText& program);
std::string zsh_completion(const ProgramText& program);
std::string fish_completion(const ProgramText& program);

}  // namespace pliant_cli
