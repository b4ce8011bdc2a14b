#include "program_text.h"

#include <algorithm>

#include <CLI/CLI.hpp>

#include "experiments.h"
#include "pliant_io/scene/builtin_scenes.h"

namespace pliant_cli {
namespace {

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

std::vector<std::string> known_values(const OptionText& argument) {
  std::vector<std::string> values = argument.choices;
  if (argument.names.front() == "scene") {
    for (const pliant::BuiltinScene& scene : pliant::builtin_scenes()) values.emplace_back(scene.name);
  } else if (argument.names.front() == "experiments") {
    values.emplace_back("all");
    for (const auto& experiment : pliant_experiments::experiments()) values.emplace_back(experiment.name);
  }
  return values;
}

}  // namespace pliant_cli
