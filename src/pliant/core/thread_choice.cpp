#include "pliant/core/thread_choice.h"

#include <algorithm>
#include <limits>

namespace pliant {
namespace {

constexpr Index first_trial = 3;      // pieces before the first one
constexpr Index longest_wait = 1024;  // pieces between two trials
constexpr Index trial_pieces = 4;     // of which the first warms caches and is not counted
constexpr double hopeless = 2;        // times the mean, that end a trial at once
constexpr double gain = 0.97;         // share of the time that another number must take at most
constexpr double change = 1.4;        // of the mean, that makes old trials worthless
constexpr double mean_share = 0.125;  // of a new piece in the mean

}  // namespace

ThreadChoice::ThreadChoice(int most) {
  for (int count = 1; count < most; count *= 2) counts_.push_back(count);
  counts_.push_back(most);
  restart();
}

ThreadChoice ThreadChoice::fixed(int threads) {
  ThreadChoice choice;
  choice.counts_ = {threads};
  return choice;
}

void ThreadChoice::restart() {
  trial_ = -1;
  pieces_ = 0;
  until_trial_ = first_trial;
  tries_larger_ = true;
  mean_ = 0;
  at_trial_ = 0;
}

void ThreadChoice::took(double seconds) {
  if (counts_.size() == 1) return;
  ++pieces_;
  if (trial_ >= 0) {
    if (pieces_ > 1) trial_sum_ += seconds;
    const bool is_hopeless = seconds > hopeless * mean_;
    if (is_hopeless) trial_sum_ = std::numeric_limits<double>::infinity();
    if (is_hopeless || pieces_ == trial_pieces) judge_trial();
    return;
  }
  mean_ = mean_ > 0 ? mean_ + mean_share * (seconds - mean_) : seconds;
  const bool has_changed = at_trial_ > 0 && (mean_ > change * at_trial_ || at_trial_ > change * mean_);
  if (has_changed) until_trial_ = std::min(until_trial_, 2 * trial_pieces);
  if (pieces_ >= until_trial_) begin_trial();
}

void ThreadChoice::begin_trial() {
  const auto last = count_of(counts_) - 1;
  if (current_ == last) tries_larger_ = false;
  if (current_ == 0) tries_larger_ = true;
  trial_ = tries_larger_ ? current_ + 1 : current_ - 1;
  pieces_ = 0;
  trial_sum_ = 0;
}

void ThreadChoice::judge_trial() {
  const double mean = trial_sum_ / (trial_pieces - 1);
  const bool wins = mean < gain * mean_;
  if (wins) {
    current_ = trial_;  // and further the same way
    mean_ = mean;
    until_trial_ = 2 * trial_pieces;
  } else {
    until_trial_ = std::min(longest_wait, 2 * std::max(until_trial_, trial_pieces));
    tries_larger_ = !tries_larger_;
  }
  at_trial_ = mean_;
  trial_ = -1;
  pieces_ = 0;
}

}  // namespace pliant
