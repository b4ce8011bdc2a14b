#include "pliant/core/thread_pool.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>

#include "pliant/core/error.h"

namespace pliant {

ThreadPool::ThreadPool(int threads) {
  if (threads < 0) {
    fail_input("threads: " + std::to_string(threads) + " is negative; give 0 for all processors, or a count from 1");
  }
  if (threads == 0) threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  workers_.reserve(static_cast<std::size_t>(threads - 1));
  shares_ = std::vector<Share>(static_cast<std::size_t>(threads));
  try {
    for (int i = 1; i < threads; ++i) workers_.emplace_back([this, i] { work(i); });
  } catch (const std::system_error&) {
    const std::string started = std::to_string(workers_.size() + 1);
    stop();
    fail_input("threads: the system gives " + started + " of " + std::to_string(threads) + "; ask for fewer");
  }
}

ThreadPool::~ThreadPool() {
  stop();
}

void ThreadPool::stop() {
  stop_ = true;
  generation_.fetch_add(1, std::memory_order_release);
  generation_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadPool::run(Index count, void* context, Call call) {
  count_ = count;
  context_ = context;
  call_ = call;
  const auto share_count = static_cast<std::int64_t>(shares_.size());
  for (std::int64_t t = 0; t < share_count; ++t) {
    Share& share = shares_[static_cast<std::size_t>(t)];
    share.next.store(static_cast<Index>(count * t / share_count), std::memory_order_relaxed);
    share.end = static_cast<Index>(count * (t + 1) / share_count);
  }
  busy_workers_.store(static_cast<int>(workers_.size()), std::memory_order_relaxed);
  generation_.fetch_add(1, std::memory_order_release);
  generation_.notify_all();
  take_iterations(0);
  for (int busy; (busy = busy_workers_.load(std::memory_order_acquire)) != 0;) busy_workers_.wait(busy);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void ThreadPool::take_iterations(int thread) {
  try {
    for (std::size_t k = 0; k < shares_.size(); ++k) {
      Share& share = shares_[(static_cast<std::size_t>(thread) + k) % shares_.size()];
      while (share.next.load(std::memory_order_relaxed) < share.end) {
        const Index i = share.next.fetch_add(1, std::memory_order_relaxed);
        if (i < share.end) call_(context_, i, thread);
      }
    }
  } catch (...) {
    for (Share& share : shares_) share.next.store(share.end, std::memory_order_relaxed);
    const std::lock_guard lock(failure_mutex_);
    if (!failure_) failure_ = std::current_exception();
  }
}

void ThreadPool::work(int thread) {
  std::uint32_t seen = 0;
  for (;;) {
    generation_.wait(seen, std::memory_order_acquire);
    seen = generation_.load(std::memory_order_acquire);
    if (stop_) return;
    take_iterations(thread);
    if (busy_workers_.fetch_sub(1, std::memory_order_release) == 1) busy_workers_.notify_one();
  }
}

}  // namespace pliant
