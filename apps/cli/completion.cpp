// Completion of command lines, made from the options themselves: one script for each shell.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "program_text.h"

namespace pliant_cli {
namespace {

std::vector<std::string> command_names(const ProgramText& program) {
  std::vector<std::string> names;
  for (const CommandText& command : program.commands) names.push_back(command.name);
  return names;
}

std::vector<std::string> option_names(const CommandText& command) {
  std::vector<std::string> names;
  for (const OptionText& option : command.options) {
    names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return names;
}

bool takes_number(const OptionText& option) {
  return option.value == "INT" || option.value == "FLOAT";
}

/// Whether a value may be the name of a file: it is no number, no choice and no assignment.
bool may_be_file(const OptionText& option) {
  return !option.value.empty() && option.choices.empty() && !takes_number(option) &&
         option.value.find('=') == option.value.npos;
}

/// In quotes of a POSIX shell.
std::string in_quotes(std::string_view text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

// ---- bash

/// The branches that complete the value behind an option of a command.
std::string bash_values(const CommandText& command, std::string_view name_before) {
  std::string out;
  for (const OptionText& option : command.options) {
    if (option.value.empty()) continue;
    std::string patterns;
    for (const std::string& name : option.names) {
      patterns += (patterns.empty() ? "" : " | ") + in_quotes(fmt::format("{} {}", name_before, name));
    }
    const std::string action =
        !option.choices.empty() ? fmt::format("words={}", in_quotes(fmt::format("{}", fmt::join(option.choices, " "))))
        : may_be_file(option)   ? std::string("files=1")
                                : std::string("words=");
    out += fmt::format("    {}) {} ;;\n", patterns, action);
  }
  return out;
}

/// The branch that completes options and arguments of a command.
std::string bash_command(const CommandText& command) {
  std::vector<std::string> values;
  bool takes_files = false;
  for (const OptionText& argument : command.arguments) {
    const std::vector<std::string> known = known_values(argument);
    values.insert(values.end(), known.begin(), known.end());
    takes_files = takes_files || argument.value == "FILE" || argument.value == "FOLDER";
  }
  return fmt::format("      {}) options={} words={}{} ;;\n", command.name,
                     in_quotes(fmt::format("{}", fmt::join(option_names(command), " "))),
                     in_quotes(fmt::format("{}", fmt::join(values, " "))), takes_files ? " files=1" : "");
}

constexpr std::string_view bash_frame = R"(# Completion of pliant for bash, made by: pliant completion bash
_pliant() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}}
  local command='' options='' words='' files='' i
  # Bash takes the '=' of --option=value for a word.
  if [[ $current == '=' ]]; then
    current=''
  elif [[ $previous == '=' && COMP_CWORD -ge 2 ]]; then
    previous=${{COMP_WORDS[COMP_CWORD-2]}}
  fi
  for ((i = 1; i < COMP_CWORD; i++)); do
    case " {0} " in *" ${{COMP_WORDS[i]}} "*) command=${{COMP_WORDS[i]}}; break ;; esac
  done
  case "$command $previous" in
{1}    *)
      case "$command" in
        '') options={2} words={3} ;;
{4}      esac ;;
  esac
  [[ $current == -* ]] && words=$options files=''
  COMPREPLY=($(compgen -W "$words" -- "$current"))
  if [[ $files ]]; then
    local IFS=$'\n'
    COMPREPLY+=($(compgen -f -- "$current"))
    compopt -o filenames 2>/dev/null
  fi
  return 0
}}
complete -F _pliant pliant
)";

// ---- zsh

/// Text within the brackets of a specification of _arguments, itself in quotes of the shell.
std::string zsh_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c == '\'' ? std::string("'\\''") : c == '`' ? std::string("\"") : std::string(1, c);
  }
  return out;
}

std::string zsh_action(const OptionText& option, const std::vector<std::string>& known) {
  const bool takes_files = option.value == "FILE" || option.value == "FOLDER";
  if (!known.empty() && takes_files) {
    return fmt::format("{{compadd -- {}; _files}}", fmt::join(known, " "));
  }
  if (!known.empty()) return fmt::format("({})", fmt::join(known, " "));
  return takes_files || may_be_file(option) ? "_files" : " ";
}

std::string zsh_options(const CommandText& command, std::string_view indent) {
  std::string out;
  for (const OptionText& option : command.options) {
    for (const std::string& name : option.names) {
      const std::string value =
          option.value.empty() ? "" : fmt::format(":{}:{}", zsh_text(option.value), zsh_action(option, option.choices));
      const bool is_long = name.starts_with("--") && !value.empty();
      out += fmt::format(" \\\n{}'*{}{}[{}]{}'", indent, name, is_long ? "=" : "", zsh_text(option.help), value);
    }
  }
  return out;
}

std::string zsh_command(const CommandText& command) {
  std::string out = fmt::format("    {}) _arguments -s", command.name) + zsh_options(command, "        ");
  for (const OptionText& argument : command.arguments) {
    const bool is_list = argument.names.front() == "experiments";
    out += fmt::format(" \\\n        '{}:{}:{}'", is_list ? "*" : "", zsh_text(argument.names.front()),
                       zsh_action(argument, known_values(argument)));
  }
  return out + " ;;\n";
}

constexpr std::string_view zsh_frame = R"(#compdef pliant
# Completion of pliant for zsh, made by: pliant completion zsh
_pliant() {{
  local curcontext=$curcontext state line
  typeset -A opt_args
  local -a commands=(
{0}  )
  _arguments -C{1} \
    '1:command:->command' '*::argument:->argument' && return 0
  if [[ $state == command ]]; then
    _describe command commands
    return
  fi
  case $line[1] in
{2}  esac
}}
if [[ $funcstack[1] == _pliant ]]; then
  _pliant "$@"
else
  compdef _pliant pliant
fi
)";

// ---- fish

std::string fish_quotes(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c;
  }
  return out + "'";
}

std::string fish_option(const OptionText& option, std::string_view condition) {
  std::string out = fmt::format("complete -c pliant -n {}", fish_quotes(condition));
  for (const std::string& name : option.names) {
    out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (!option.choices.empty()) {
    out += fmt::format(" -x -a {}", fish_quotes(fmt::format("{}", fmt::join(option.choices, " "))));
  } else if (!option.value.empty()) {
    out += may_be_file(option) ? " -r -F" : " -x";
  }
  return out + fmt::format(" -d {}\n", fish_quotes(option.help));
}

std::string fish_command(const CommandText& command) {
  const std::string condition = "__fish_seen_subcommand_from " + command.name;
  std::string out =
      fmt::format("complete -c pliant -n __fish_use_subcommand -a {} -d {}\n", command.name, fish_quotes(command.help));
  for (const OptionText& option : command.options) out += fish_option(option, condition);
  for (const OptionText& argument : command.arguments) {
    const std::vector<std::string> known = known_values(argument);
    const bool takes_files = argument.value == "FILE" || argument.value == "FOLDER";
    if (takes_files) out += fmt::format("complete -c pliant -n {} -F\n", fish_quotes(condition));
    if (known.empty()) continue;
    out += fmt::format("complete -c pliant -n {} -a {}\n", fish_quotes(condition),
                       fish_quotes(fmt::format("{}", fmt::join(known, " "))));
  }
  return out;
}

}  // namespace

std::string bash_completion(const ProgramText& program) {
  std::string values = bash_values(program.program, "");
  std::string commands;
  for (const CommandText& command : program.commands) {
    values += bash_values(command, command.name);
    commands += "  " + bash_command(command);
  }
  const std::string names = fmt::format("{}", fmt::join(command_names(program), " "));
  return fmt::format(bash_frame, names, values,
                     in_quotes(fmt::format("{}", fmt::join(option_names(program.program), " "))), in_quotes(names),
                     commands);
}

std::string zsh_completion(const ProgramText& program) {
  std::string names;
  std::string commands;
  for (const CommandText& command : program.commands) {
    names += fmt::format("    '{}:{}'\n", command.name, zsh_text(command.help));
    commands += zsh_command(command);
  }
  return fmt::format(zsh_frame, names, zsh_options(program.program, "    "), commands);
}

std::string fish_completion(const ProgramText& program) {
  std::string out = "# Completion of pliant for fish, made by: pliant completion fish\ncomplete -c pliant -f\n";
  for (const OptionText& option : program.program.options) out += fish_option(option, "__fish_use_subcommand");
  for (const CommandText& command : program.commands) out += fish_command(command);
  return out;
}

}  // namespace pliant_cli
