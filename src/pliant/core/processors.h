#pragma once

namespace pliant {

/// Whether threads can be started. WebAssembly has none, unless it is built for pages that are served in isolation.
bool can_start_threads();

/// How many threads the system runs side by side, at least 1.
int processor_count();

}  // namespace pliant
