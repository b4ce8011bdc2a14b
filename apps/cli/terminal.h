#pragma once
// What people read and answer on a terminal.
#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace pliant_cli {

/// Writes to the standard error; in color where it has some: labels such as "warning:", and lines of progress. What
/// cannot be written there has nowhere else to go: it is dropped.
void print_to_stderr(std::string_view text);
/// A line of progress begins with this: it takes the place of the line before.
inline constexpr std::string_view rewritten_line = "\r\x1b[K";

/// Whether what is printed has colors: where people read it on a terminal, always, or never. Without a choice NO_COLOR
/// (no-color.org) and TERM=dumb say never.
enum class Ansi { automatic, always, never };
constexpr std::array<std::string_view, 3> choice_names(Ansi) {
  return {"auto", "always", "never"};
}
void choose_ansi(Ansi choice);

enum class Tone { good, warning, bad };
/// Text for the standard output, in color where it has some.
std::string in_tone(Tone tone, std::string_view text);

/// True when people read the standard error on a terminal.
bool has_error_terminal();

/// Asks on the terminal; yes is a line that begins with y. Nothing where nobody reads or answers there.
std::optional<bool> ask(std::string_view question);

}  // namespace pliant_cli
