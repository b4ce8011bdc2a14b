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
inline constexpr std::array<ExitCode, 5> exit_codes = {{{0, "done"},
                                                        {2, "bad input"},
                                                        {3, "the simulation diverged"},
                                                        {4, "the output could not be written"},
                                                        {130, "interrupted"}}};

struct Example {
  std::string_view command;
  std::string_view text;
};
inline constexpr std::array<Example, 12> program_examples = {{
    {"pliant scenes", "lists the built-in scenes"},
    {"pliant run curtain_wind --out out/curtain", "simulates one of them"},
    {"pliant run shirt.obj --up y", "simulates a mesh of your own, as cloth"},
    {"pliant check my_scene.json", "says what is in a scene of your own, and what is wrong with it"},
    {"pliant resume out/curtain --steps 900", "continues a run, up to step 900"},
    {"pliant view curtain_wind", "opens a window in which you can pull at it"},
    {"pliant render curtain_wind --out curtain.mp4", "makes a film, without a display"},
    {"pliant convert out/curtain curtain.glb", "exports a run as an animation"},
    {"pliant sweep curtain --vary settings.iterations=5,10,20 --out out/sweep", "runs and compares all of these"},
    {"pliant experiment all --out report", "repeats the experiments of the thesis, with figures and verdicts"},
    {"pliant info shirt.ply", "describes a mesh and what is wrong with it"},
    {"pliant bench", "measures how fast this machine is, part by part"},
}};

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
