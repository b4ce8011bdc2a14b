#pragma once
// What depends on the operating system: signals, terminals and the three standard streams.
#include <string>
#include <string_view>

namespace pliant_cli {

/// To be called first. A closed standard stream becomes the null device, so that no file of a run takes its number and
/// with it what is printed there; a reader that has gone and a file past its limit become errors of the write.
void guard_streams();

/// A text that may hold anything, such as a name from a file, as one line that leaves a terminal as it is: control
/// characters, of ASCII and of UTF-8, become question marks.
std::string printable(std::string_view text);

/// Writes to the standard error. What cannot be written there has nowhere else to go: it is dropped.
void print_to_stderr(std::string_view text);

/// From now on the first SIGINT or SIGTERM only raises a flag; a second one ends the program.
void catch_interrupts();
bool was_interrupted();

/// True when people read the standard error on a terminal.
bool has_error_terminal();

}  // namespace pliant_cli
