#include "pliant/solver/threads.h"

#include <algorithm>

#include "pliant/core/processors.h"

namespace pliant {
namespace {

/// Slots for which another thread is worth waking: below, handing out the work takes longer than the work, and so even
/// who asks for threads is given fewer. Where their number is left to us, the clock decides among these (ThreadChoice).
constexpr std::size_t slots_per_thread = 4096;

int useful_threads(Index asked, std::size_t slots) {
  if (!can_start_threads()) return 1;  // also where a scene asks for some: results do not depend on them
  const auto most = static_cast<std::size_t>(asked > 0 ? asked : processor_count());
  return static_cast<int>(std::clamp<std::size_t>(slots / slots_per_thread, 1, most));
}

}  // namespace

void SolverThreads::fit(Index asked, std::size_t slots) {
  const int threads = useful_threads(asked, slots);
  const bool is_same_pool = threads == pool_->thread_count();
  if (!is_same_pool) pool_ = std::make_unique<ThreadPool>(threads);
  if (asked > 0) {
    choice_ = ThreadChoice::fixed(threads);
  } else if (!is_same_pool || asked_ > 0) {
    choice_ = ThreadChoice(threads);
  } else {
    choice_.restart();
  }
  asked_ = asked;
}

}  // namespace pliant
