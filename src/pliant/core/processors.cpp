#include "pliant/core/processors.h"

#include <algorithm>
#include <thread>

namespace pliant {

bool can_start_threads() {
#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
  return false;
#else
  return true;
#endif
}

int processor_count() {
  if (!can_start_threads()) return 1;
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace pliant
