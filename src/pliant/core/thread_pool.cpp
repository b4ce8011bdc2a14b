#include "pliant/core/thread_pool.h"

#include <string>
#include <system_error>
#include <utility>

#include "pliant/core/error.h"
#include "pliant/core/processors.h"

namespace pliant {
namespace {

/// How long threads look for the next loop of a step before they sleep; what more or less gives is in
/// benchmarks/NOTES.md. None look where a pool has more threads than the machine has processors.
constexpr auto time_to_look = std::chrono::microseconds(50);

}  // namespace

ThreadPool::ThreadPool(int threads) {
  if (threads < 0) {
    fail_input("threads: " + std::to_string(threads) + " is negative; give 0 for all processors, or a count from 1");
  }
  if (threads == 0) threads = processor_count();
  workers_ = std::vector<Worker>(static_cast<std::size_t>(threads - 1));
  shares_ = std::vector<Share>(static_cast<std::size_t>(threads));
  active_ = threads;
  patience_ = threads <= processor_count() ? time_to_look : WaitedCount::Patience::zero();
  int started = 1;
  try {
    for (; started < threads; ++started) {
      workers_[static_cast<std::size_t>(started - 1)].thread = std::thread([this, started] { work(started); });
    }
  } catch (const std::system_error&) {
    stop();
    fail_input("threads: the system gives " + std::to_string(started) + " of " + std::to_string(threads) +
               "; ask for fewer");
  }
}

ThreadPool::~ThreadPool() {
  stop();
}

void ThreadPool::stop() {
  stop_ = true;
  for (Worker& worker : workers_) {
    if (!worker.thread.joinable()) continue;
    summon(worker);
    worker.thread.join();
  }
}

void ThreadPool::summon(Worker& worker) {
  worker.calls.value.fetch_add(1);
  worker.calls.wake();
}

void ThreadPool::run(Index count, void* context, Call call) {
  context_ = context;
  call_ = call;
  sharing_ = active_;
  for (int t = 0; t < sharing_; ++t) {
    Share& share = shares_[static_cast<std::size_t>(t)];
    share.next.store(static_cast<Index>(std::int64_t{count} * t / sharing_), std::memory_order_relaxed);
    share.end = static_cast<Index>(std::int64_t{count} * (t + 1) / sharing_);
  }
  gate_.value.store(is_open, std::memory_order_release);
  for (int t = 1; t < sharing_; ++t) {
    summon(workers_[static_cast<std::size_t>(t - 1)]);
  }
  take_iterations(0);
  // All iterations are taken: whoever comes now stays out, and who is inside is waited for.
  std::uint32_t inside = gate_.value.fetch_and(~is_open) & ~is_open;
  while (inside != 0) inside = gate_.wait_while(inside, patience_);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void ThreadPool::take_iterations(int thread) {
  const auto count = static_cast<std::size_t>(sharing_);
  try {
    for (std::size_t k = 0; k < count; ++k) {
      Share& share = shares_[(static_cast<std::size_t>(thread) + k) % count];
      while (share.next.load(std::memory_order_relaxed) < share.end) {
        const Index i = share.next.fetch_add(1, std::memory_order_relaxed);
        if (i < share.end) call_(context_, i, thread);
      }
    }
  } catch (...) {
    for (std::size_t k = 0; k < count; ++k) shares_[k].next.store(shares_[k].end, std::memory_order_relaxed);
    const std::lock_guard lock(failure_mutex_);
    if (!failure_) failure_ = std::current_exception();
  }
}

/// Whether there is a loop that may be entered; then leave() must follow.
bool ThreadPool::enter() {
  std::uint32_t gate = gate_.value.load(std::memory_order_acquire);
  while ((gate & is_open) != 0) {
    if (gate_.value.compare_exchange_weak(gate, gate + 1, std::memory_order_acq_rel, std::memory_order_acquire))
      return true;
  }
  return false;
}

void ThreadPool::leave() {
  if (gate_.value.fetch_sub(1) == 1) gate_.wake();  // closed, and nobody is left inside
}

void ThreadPool::work(int thread) {
  WaitedCount& calls = workers_[static_cast<std::size_t>(thread - 1)].calls;
  std::uint32_t seen = 0;
  for (;;) {
    seen = calls.wait_while(seen, patience_);
    if (stop_) return;
    if (!enter()) continue;
    // A loop with fewer threads may have come since this one was called: it has no share then.
    if (thread < sharing_) take_iterations(thread);
    leave();
  }
}

}  // namespace pliant
