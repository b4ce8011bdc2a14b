#include "program_text.h"

#include <algorithm>
#include <array>
#include <iterator>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands.h"
#include "pliant_io/scene/builtin_scenes.h"

namespace pliant_cli {
namespace {

constexpr std::array<Example, 12> all_examples = {{
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

/// "TEXT:{npy,pc2}" → npy, pc2.
std::vector<std::string> choices_of(const std::string& type) {
  std::vector<std::string> choices;
  const std::size_t open = type.find('{');
  const std::size_t close = type.find('}', open == type.npos ? 0 : open);
  if (open == type.npos || close == type.npos) return choices;
  std::size_t begin = open + 1;
  while (begin < close) {
    const std::size_t end = std::min(type.find(',', begin), close);
    choices.push_back(type.substr(begin, end - begin));
    begin = end + 1;
  }
  return choices;
}

OptionText describe_option(const CLI::Option& option) {
  OptionText text;
  if (option.get_positional()) {
    text.names = {option.get_name(true)};
  } else {
    for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  }
  if (option.get_expected_max() > 0 && option.get_type_size_max() > 0) {
    const std::string type = option.get_type_name();
    text.value = type.substr(0, type.find(':'));
    text.choices = choices_of(type);
  }
  text.help = option.get_description();
  return text;
}

}  // namespace

CommandText describe_command(const CLI::App& command) {
  CommandText text{command.get_name(), command.get_description(), command.get_footer(), {}, {}};
  for (const CLI::Option* option : command.get_options()) {
    (option->get_positional() ? text.arguments : text.options).push_back(describe_option(*option));
  }
  return text;
}

ProgramText describe_program(const CLI::App& program) {
  ProgramText text{describe_command(program), {}};
  for (const CLI::App* command : program.get_subcommands({})) {
    if (!command->get_group().empty()) text.commands.push_back(describe_command(*command));
  }
  return text;
}

std::vector<Example> program_examples() {
  std::vector<Example> examples(all_examples.begin(), all_examples.end());
  if constexpr (!has_studies) {
    std::erase_if(examples, [](const Example& example) {
      return std::ranges::any_of(study_commands, [&](std::string_view name) {
        return example.command.starts_with(fmt::format("pliant {}", name));
      });
    });
  }
  return examples;
}

std::vector<std::string> known_values(const OptionText& argument) {
  std::vector<std::string> values = argument.choices;
  if (argument.names.front() == "scene") {
    for (const pliant::BuiltinScene& scene : pliant::builtin_scenes()) values.emplace_back(scene.name);
  } else if (argument.names.front() == "experiments") {
    values.emplace_back("all");
    if constexpr (has_studies) std::ranges::copy(experiment_names(), std::back_inserter(values));
  }
  return values;
}

}  // namespace pliant_cli
