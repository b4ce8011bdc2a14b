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

/// Where the system has no call that waits for a number, the standard library of GCC before 13 may lose a wake between
/// a look and the wait (its bug 106183), and sleep for ever: there the count is looked at from time to time.
void sleep_while(const std::atomic<std::uint32_t>& value, std::uint32_t old) {
#if defined(__GLIBCXX__) && _GLIBCXX_RELEASE < 13 && !defined(_GLIBCXX_HAVE_PLATFORM_WAIT)
  while (value.load() == old) std::this_thread::sleep_for(std::chrono::microseconds(50));
#else
  value.wait(old);
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
  sleep_while(value, old);
  is_asleep_.store(false);
  return value.load(std::memory_order_acquire);
}

}  // namespace pliant
