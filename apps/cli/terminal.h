#pragma once
// What depends on the operating system: signals and terminals.

namespace pliant_cli {

/// From now on the first SIGINT or SIGTERM only raises a flag; a second one ends the program.
void catch_interrupts();
bool was_interrupted();

/// True when people read the standard error on a terminal.
bool has_error_terminal();

}  // namespace pliant_cli
