// The man page, made from the options themselves.
#include <fmt/format.h>

#include "pliant/core/version.h"
#include "program_text.h"

namespace pliant_cli {
namespace {

/// One line of text as roff takes it: no character commands anything, `quoted` words are bold.
std::string roff(std::string_view text) {
  std::string out = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
  bool is_bold = false;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else if (c == '\'') {
      out += "\\(aq";
    } else if (c == '`') {
      is_bold = !is_bold;
      out += is_bold ? "\\fB" : "\\fP";
    } else {
      out += c;
    }
  }
  return is_bold ? out + "\\fP" : out;
}

/// Paragraphs as they are; indented lines are shown as they stand.
std::string footer_roff(std::string_view footer) {
  std::string out;
  bool is_literal = false;
  while (!footer.empty()) {
    const std::string_view line = footer.substr(0, footer.find('\n'));
    footer.remove_prefix(std::min(footer.size(), line.size() + 1));
    const bool is_indented = line.starts_with("  ");
    if (is_indented != is_literal) out += is_indented ? ".nf\n" : ".fi\n";
    is_literal = is_indented;
    if (!line.empty()) out += roff(line) + "\n";
  }
  return is_literal ? out + ".fi\n" : out;
}

std::string option_roff(const OptionText& option) {
  std::string names;
  for (const std::string& name : option.names) names += (names.empty() ? "" : ", ") + ("\\fB" + roff(name) + "\\fP");
  std::string value;
  if (!option.choices.empty()) {
    for (const std::string& choice : option.choices) value += (value.empty() ? " " : "|") + roff(choice);
  } else if (!option.value.empty()) {
    value += " \\fI" + roff(option.value) + "\\fP";
  }
  return fmt::format(".TP\n{}{}\n{}\n", names, value, roff(option.help));
}

std::string command_roff(const CommandText& command) {
  std::string out = fmt::format(".SS pliant {}", command.name);
  std::string usage = fmt::format("\\fBpliant {}\\fP", command.name);
  for (const OptionText& argument : command.arguments)
    usage += fmt::format(" \\fI{}\\fP", roff(argument.names.front()));
  if (command.options.size() > 1) usage += " [\\fIoptions\\fP]";
  out += fmt::format("\n{}\n.PP\n{}.\n", usage, roff(command.help));
  for (const OptionText& argument : command.arguments) {
    OptionText named = argument;
    named.value.clear();
    out += option_roff(named);
  }
  for (const OptionText& option : command.options) out += option_roff(option);
  return command.footer.empty() ? out : out + ".PP\n" + footer_roff(command.footer);
}

constexpr std::string_view man_description = R"(.SH DESCRIPTION
Pliant simulates cloth, ropes and soft bodies by Projective Dynamics (Bouaziz et al. 2014). A scene is a JSON file, the
name of a built-in scene, or a mesh file, which is simulated by itself. A run leaves its frames, measurements and a
checkpoint in a folder; other commands continue, show and export such a folder.
)";

constexpr std::string_view files_and_environment = R"(.SH FILES
The folder of a run holds:
.TP
\fBrun.json\fP
settings, versions, totals and how the run ended
.TP
\fBmeasurements.csv\fP
energies, momenta, residual and times of each recorded step
.TP
\fBframes.npy\fP, \fBframes.pc2\fP, \fBframe_*.obj\fP, \fBframe_*.ply\fP
the positions of all vertices
.TP
\fBmesh.obj\fP
the mesh that the frames move
.TP
\fBcheckpoint.pliant\fP
from which \fBpliant resume\fP continues
.SH ENVIRONMENT
.TP
\fBNO_COLOR\fP
if set and not empty, messages have no colors
.TP
\fBDISPLAY\fP, \fBWAYLAND_DISPLAY\fP
where \fBpliant view\fP opens its window
)";

}  // namespace

std::string man_page(const ProgramText& program) {
  std::string out = fmt::format(
      ".\\\" Made by `pliant man`.\n.TH PLIANT 1 \"\" \"Pliant {}\" \"User Commands\"\n"
      ".SH NAME\npliant \\- {}\n"
      ".SH SYNOPSIS\n\\fBpliant\\fP [\\fIoptions\\fP] \\fIcommand\\fP [\\fIarguments\\fP]\n",
      roff(pliant::version), roff(program.program.help));
  out += std::string(man_description) + ".SH COMMANDS\n";
  for (const CommandText& command : program.commands) out += command_roff(command);
  out += ".SH OPTIONS\nThese stand before the command.\n";
  for (const OptionText& option : program.program.options) out += option_roff(option);
  out += ".SH EXIT STATUS\n";
  for (const auto& [code, meaning] : exit_codes) out += fmt::format(".TP\n\\fB{}\\fP\n{}\n", code, roff(meaning));
  out += std::string(files_and_environment) + ".SH EXAMPLES\n";
  for (const auto& [command, text] : program_examples())
    out += fmt::format(".TP\n\\fB{}\\fP\n{}\n", roff(command), roff(text));
  return out + ".SH SEE ALSO\n\\fBffmpeg\\fP(1), which makes the films of \\fBpliant render\\fP\n";
}

}  // namespace pliant_cli
