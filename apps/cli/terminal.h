#pragma once
// What depends on the operating system: signals, terminals and the three standard streams.
#include <string_view>

namespace pliant_cli {

/// To be called first. A closed standard stream becomes the null device, so that no file of a run takes its number and
/// with it what is printed there; a reader that has gone and a file past its limit become errors of the write.
void guard_streams();

/// Lets no allocation go past the memory that is free now, so that a scene too large for this machine ends in
/// std::bad_alloc, and not with the system killing this program or another.
void limit_memory();
/// Writes to the standard error. What cannot be written there has nowhere else to go: it is dropped.
void print_to_stderr(std::string_view text);

/// From now on an interrupt ends the program at once, with the exit code of interrupts: nothing has to be finished.
void end_at_interrupts();

/// From now on the first SIGINT, SIGTERM, SIGHUP or SIGXCPU only raises a flag; a second one ends the program.
void catch_interrupts();
bool was_interrupted();
/// Whether that was longer ago than a step may take that is to be finished.
bool waits_no_longer();
inline constexpr unsigned patience = 2;  // [s]

/// True when people read the standard error on a terminal.
bool has_error_terminal();

}  // namespace pliant_cli
