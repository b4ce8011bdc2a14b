#pragma once
// Threads for loops whose iterations write to places of their own. Which thread runs which iteration is left open, so
// a loop body must not depend on it; sums are made afterwards, in the order of the iterations. Every thread begins with
// the same share of a loop each time, so that what it reads again and again stays in its cache, and then helps others.
//
// A loop ends when its iterations are done, not when every thread has looked for one: a thread that the system does not
// run, because other programs want the processor, holds nobody up unless it is in the middle of an iteration.
//
// Between loops threads look for the next one for a while, and give way to others as they do, before they sleep.
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <type_traits>
#include <vector>

#include "pliant/core/types.h"
#include "pliant/core/waited_count.h"

namespace pliant {

class ThreadPool {
 public:
  /// threads ≥ 1, or 0 for one thread a processor. Throws Error(input) on a negative count, and when the system does
  /// not give that many.
  explicit ThreadPool(int threads = 0);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int thread_count() const { return static_cast<int>(workers_.size()) + 1; }

  /// How many of the threads take part in loops from now on, from 1 to thread_count(); at first all. Costs nothing.
  void set_active(int threads) { active_ = threads; }
  int active() const { return active_; }

  /// Calls body(i), or body(i, thread) with thread in [0, active()), once for every i in [0, count), and returns
  /// when all are done. Never allocates. The first exception that a body throws is thrown again here.
  template <class Body>
  void parallel_for(Index count, Body&& body) {
    using Plain = std::remove_reference_t<Body>;
    void* const context = const_cast<void*>(static_cast<const void*>(&body));
    if (active_ == 1 || count <= 1) {
      for (Index i = 0; i < count; ++i) call_body<Plain>(context, i, 0);
    } else {
      run(count, context, call_body<Plain>);
    }
  }

 private:
  using Call = void (*)(void* context, Index i, int thread);
  /// The iterations that a thread begins with, on a cache line of its own.
  struct alignas(64) Share {
    std::atomic<Index> next{0};
    Index end = 0;
  };
  /// One thread besides the caller's.
  struct Worker {
    WaitedCount calls;  // one more for every loop it is called to, and once more to stop
    std::thread thread;
  };

  template <class Body>
  static void invoke(Body& body, Index i, int thread) {
    if constexpr (std::is_invocable_v<Body&, Index, int>) {
      body(i, thread);
    } else {
      body(i);
    }
  }

  /// Not inlined: one thread runs the same code as several. GCC 12 for ARM gave other bits in a loop of which it made
  /// one copy for each of the two.
  template <class Plain>
  [[gnu::noinline]] static void call_body(void* context, Index i, int thread) {
    invoke(*static_cast<Plain*>(context), i, thread);
  }

  void stop();
  static void summon(Worker& worker);
  void run(Index count, void* context, Call call);
  void take_iterations(int thread);
  void work(int thread);
  bool enter();
  void leave();

  /// Of a loop that may be entered; below it the number of workers that have entered and not left.
  static constexpr std::uint32_t is_open = std::uint32_t{1} << 31U;

  std::vector<Worker> workers_;
  std::vector<Share> shares_;
  WaitedCount gate_;
  std::atomic<bool> stop_{false};
  WaitedCount::Patience patience_{};  // of threads that wait for a loop, or for its end
  int active_ = 1;
  int sharing_ = 1;  // threads of the loop under way; this and the rest are written while the gate is closed and empty
  void* context_ = nullptr;
  Call call_ = nullptr;
  std::mutex failure_mutex_;
  std::exception_ptr failure_;
};

}  // namespace pliant
