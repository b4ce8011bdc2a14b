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
  next_.store(0, std::memory_order_relaxed);
  busy_workers_.store(static_cast<int>(workers_.size()), std::memory_order_relaxed);
  generation_.fetch_add(1, std::memory_order_release);
  generation_.notify_all();
  take_iterations(0);
  for (int busy; (busy = busy_workers_.load(std::memory_order_acquire)) != 0;) busy_workers_.wait(busy);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void ThreadPool::take_iterations(int thread) {
  try {
    for (Index i; (i = next_.fetch_add(1, std::memory_order_relaxed)) < count_;) call_(context_, i, thread);
  } catch (...) {
    next_.store(count_, std::memory_order_relaxed);
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
