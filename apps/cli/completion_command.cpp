// pliant completion: the scripts that complete its command line; and, hidden, pliant man: its man page.
#include <array>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "choice_option.h"
#include "commands.h"
#include "program_text.h"

namespace pliant_cli {
namespace {

enum class Shell { bash, zsh, fish };
constexpr std::array<std::string_view, 3> choice_names(Shell) {
  return {"bash", "zsh", "fish"};
}

std::string completion_of(Shell shell, const ProgramText& program) {
  switch (shell) {
    case Shell::bash:
      return bash_completion(program);
    case Shell::zsh:
      return zsh_completion(program);
    case Shell::fish:
      break;
  }
  return fish_completion(program);
}

}  // namespace

void add_completion_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("completion", "Print a script that completes command lines in a shell");
  const auto shell = std::make_shared<Shell>();
  add_choice(*command, "shell", *shell, "Your shell: bash, zsh or fish").required();
  command->footer(
      "Examples:\n"
      "  source <(pliant completion bash)                                   for this shell\n"
      "  pliant completion fish > ~/.config/fish/completions/pliant.fish    for all to come");
  command->callback([&program, shell] { fmt::print("{}", completion_of(*shell, describe_program(program))); });
}

void add_man_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("man", "Print the man page, in roff");
  command->group("");  // for those who install it
  command->callback([&program] { fmt::print("{}", man_page(describe_program(program))); });
}

}  // namespace pliant_cli
