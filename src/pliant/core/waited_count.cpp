#include "pliant/core/waited_count.h"

#include <thread>

namespace pliant {
namespace {

constexpr int looks = 64;  // between two that let other threads have the processor

/// Tells the processor that this thread only waits.
void relax() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

}  // namespace

std::uint32_t WaitedCount::wait_while(std::uint32_t old, Patience patience) {
  using Clock = std::chrono::steady_clock;
  if (patience > Patience::zero()) {
    const auto end = Clock::now() + patience;
    do {
      for (int look = 0; look < looks; ++look) {
        const std::uint32_t now = value.load(std::memory_order_acquire);
        if (now != old) return now;
        relax();
      }
      std::this_thread::yield();
    } while (Clock::now() < end);
  }
  // Whoever changes the value after this sees the flag, and whoever changed it before is seen by wait().
  is_asleep_.store(true);
  value.wait(old);
  is_asleep_.store(false);
  return value.load(std::memory_order_acquire);
}

}  // namespace pliant
