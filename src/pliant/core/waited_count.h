#pragma once
// A count on which one thread waits while others change it. It looks for a while before it sleeps: to wake many threads
// takes the system as long as many loops of a step take themselves.
#include <atomic>
#include <chrono>
#include <cstdint>

namespace pliant {

class alignas(64) WaitedCount {
 public:
  using Patience = std::chrono::nanoseconds;

  std::atomic<std::uint32_t> value{0};

  /// Waits until the value differs from `old`, and returns it. Only one thread may wait at a time.
  std::uint32_t wait_while(std::uint32_t old, Patience patience);
  /// To be called after the value was changed: costs nothing unless the thread that waits has gone to sleep.
  void wake() {
    if (is_asleep_.load()) value.notify_one();
  }

 private:
  std::atomic<bool> is_asleep_{false};
};

}  // namespace pliant
