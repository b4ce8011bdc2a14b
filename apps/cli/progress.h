#pragma once
#include <chrono>
#include <cstdint>
#include <string>

namespace pliant_cli {

/// "40 s", "5 min", "1.5 h"
std::string duration_text(double seconds);

/// One line on a terminal, written anew a few times a second.
class Progress {
 public:
  enum class Show { never, on_terminal };

  /// Of the steps from `first` to `last`.
  Progress(std::int64_t first, std::int64_t last, Show show);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// After a step; residual [N] of the last record.
  void update(std::int64_t step, double residual);
  /// Takes the line away, so that something else can be printed.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::int64_t first_;
  std::int64_t last_step_;
  bool active_;
  bool shown_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

}  // namespace pliant_cli
