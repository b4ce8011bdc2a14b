#include "terminal.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>

#include "system/streams.h"

namespace pliant_cli {

namespace {

using pliant_system::is_terminal;
using pliant_system::Stream;

Ansi ansi = Ansi::automatic;

bool has_colors(Stream stream) {
  if (ansi != Ansi::automatic) return ansi == Ansi::always;
  const char* no_color = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  if (no_color != nullptr && *no_color != '\0') return false;
  return is_terminal(stream) && (terminal == nullptr || std::string_view(terminal) != "dumb");
}

std::string with_code(std::string_view code, std::string_view text) {
  return "\x1b[" + std::string(code) + "m" + std::string(text) + "\x1b[0m";
}

struct Label {
  std::string_view text;
  std::string_view code;
};
constexpr std::string_view red = "1;31", yellow = "1;33", green = "32", cyan = "36";
constexpr std::array labels = {Label{"pliant: error:", red}, Label{"warning:", yellow}, Label{"interrupted:", yellow},
                               Label{"note:", cyan}, Label{"hint:", cyan}};

std::string colored(std::string_view text) {
  if (text.starts_with(rewritten_line)) {
    const std::string_view line = text.substr(rewritten_line.size());
    return std::string(rewritten_line) + (line.empty() ? "" : with_code(cyan, line));
  }
  for (const Label& label : labels) {
    if (text.starts_with(label.text))
      return with_code(label.code, label.text) + std::string(text.substr(label.text.size()));
  }
  return std::string(text);
}

}  // namespace

void choose_ansi(Ansi choice) {
  ansi = choice;
}

std::string in_tone(Tone tone, std::string_view text) {
  if (!has_colors(Stream::output)) return std::string(text);
  return with_code(tone == Tone::good ? green : tone == Tone::warning ? yellow : red, text);
}

void print_to_stderr(std::string_view text) {
  const std::string printed = has_colors(Stream::error) ? colored(text) : std::string(text);
  std::fwrite(printed.data(), 1, printed.size(), stderr);
  std::fflush(stderr);
}

bool has_error_terminal() {
  return is_terminal(Stream::error);
}

std::optional<bool> ask(std::string_view question) {
  if (!has_error_terminal() || !is_terminal(Stream::input)) return {};
  print_to_stderr(std::string(question) + " [y/N] ");
  std::string answer;
  std::getline(std::cin, answer);
  return answer.starts_with('y') || answer.starts_with('Y');
}

}  // namespace pliant_cli
