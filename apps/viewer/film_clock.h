#pragma once
// Which moments of what a window shows become pictures of a film.
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pliant_viewer {

/// A film has so many pictures a second of the time that is shown, however long they take to draw.
class FilmClock {
 public:
  /// `fps`: pictures a second of the film.
  explicit FilmClock(int fps) : fps_(fps) {}

  /// Whether a moment is a picture of the film. `cuts`: how often time has not gone on evenly, as at a restart, after
  /// which the film goes on at once.
  bool is_due(double time, std::uint64_t cuts) const {
    return !has_begun_ || cuts != cuts_ || time < last_ || time >= next_ - rounding;
  }
  /// How many pictures of the film this moment is. `speed`: simulated seconds in a second of the film.
  int take_due(double time, double speed, std::uint64_t cuts) {
    if (!is_due(time, cuts)) return 0;
    if (!has_begun_ || cuts != cuts_ || time < last_) next_ = time;
    has_begun_ = true;
    cuts_ = cuts;
    last_ = time;
    const double interval = speed / fps_;
    const double late = std::floor((time + rounding - next_) / interval);
    const int due = 1 + static_cast<int>(std::clamp(late, 0.0, most_at_once));
    next_ += due * interval;
    pictures_ += due;
    return due;
  }
  /// The time at which the next picture is due [s].
  double next_time() const { return next_ - rounding; }
  int pictures() const { return pictures_; }                               ///< so far
  double length() const { return pictures_ / static_cast<double>(fps_); }  ///< of the film so far [s]

 private:
  static constexpr double rounding = 1e-7;      // of sums of time steps [s]
  static constexpr double most_at_once = 1000;  // of a run with long pauses between its frames

  int fps_;
  bool has_begun_ = false;
  std::uint64_t cuts_ = 0;
  double last_ = 0, next_ = 0;  // [s]
  int pictures_ = 0;
};

}  // namespace pliant_viewer
