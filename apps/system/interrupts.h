#pragma once
// What Ctrl-C, and a system that ends programs, do: at first only a flag, so that what is being written is finished.

namespace pliant_system {

/// From now on an interrupt ends the program at once, with the exit code of interrupts: nothing has to be finished.
void end_at_interrupts();

/// From now on the first SIGINT, SIGTERM, SIGHUP or SIGXCPU only raises a flag; a second one ends the program.
void catch_interrupts();
bool was_interrupted();
/// Whether that was longer ago than a step may take that is to be finished.
bool waits_no_longer();
inline constexpr unsigned patience = 2;  // [s]

}  // namespace pliant_system
