#pragma once
// The threads of a solver: as many as were asked for, or as many as pay.
#include <memory>

#include "pliant/core/thread_choice.h"
#include "pliant/core/thread_pool.h"

namespace pliant {

class SolverThreads {
 public:
  SolverThreads() : pool_(std::make_unique<ThreadPool>(1)) {}

  /// For a local step of so many slots; asked: threads at most, 0: as many as pay, found while running. Fewer where the
  /// slots are few. Throws Error(input), with nothing changed, when the system does not give that many.
  void fit(Index asked, std::size_t slots);

  /// An iteration begins, and has ended after so long [s]: what the clock judges by.
  void begin_iteration() { pool_->set_active(choice_.threads()); }
  void end_iteration(double seconds) { choice_.took(seconds); }

  ThreadPool& pool() { return *pool_; }
  /// In use since the last iteration.
  int active() const { return pool_->active(); }

 private:
  std::unique_ptr<ThreadPool> pool_;
  ThreadChoice choice_;
  Index asked_ = 0;
};

}  // namespace pliant
