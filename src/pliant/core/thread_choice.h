#pragma once
// How many threads pay, found while running: a loop's results do not depend on their number, so the clock may decide.
//
// One number of threads is in use. Now and then the next larger or smaller one is tried for a few pieces of work and
// taken where it was faster. A number that lost is tried again after twice as many pieces, up to a limit, so that what
// trials cost stays small; when the time of a piece changes, because another program came or went, trials begin anew.
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

class ThreadChoice {
 public:
  /// Numbers from 1 to `most` ≥ 1: 1, 2, 4, ... and `most` itself. Begins with one thread.
  explicit ThreadChoice(int most = 1);

  /// Always as many, whatever the clock says.
  static ThreadChoice fixed(int threads);

  /// For the next piece of work.
  int threads() const { return counts_[at(trial_ >= 0 ? trial_ : current_)]; }
  /// What that piece took [s]. Pieces are of about the same work.
  void took(double seconds);
  /// The work is another from now on: what was measured no longer counts.
  void restart();

 private:
  void judge_trial();
  void begin_trial();

  std::vector<int> counts_;
  Index current_ = 0;
  Index trial_ = -1;          // number under trial; -1: none
  Index pieces_ = 0;          // since the last trial, or of the trial
  Index until_trial_ = 0;     // pieces from one trial to the next
  bool tries_larger_ = true;  // the next trial
  double mean_ = 0;           // of late pieces with the current number [s]
  double at_trial_ = 0;       // that mean when the last trial was judged
  double trial_sum_ = 0;
};

}  // namespace pliant
