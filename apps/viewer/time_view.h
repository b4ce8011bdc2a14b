#pragma once
// Which part of the time plots show.
#include <algorithm>
#include <optional>

namespace pliant_viewer {

struct TimeRange {
  double from = 0;  ///< [s]
  double to = 0;    ///< [s]
  double length() const { return to - from; }
  double at(double share) const { return from + share * length(); }
};

/// All of it, the last of it, which goes on with time, or a range that stays.
class TimeView {
 public:
  /// What is shown of times from first to last.
  TimeRange range(const TimeRange& known) const {
    if (!length_ || !(*length_ < known.length())) return known;
    const double latest = known.to - *length_;
    const double from = follows_ ? latest : std::clamp(from_, known.from, latest);
    return {from, from + *length_};
  }
  /// The length of what is shown [s]; none: all.
  std::optional<double> length() const { return length_; }
  bool follows() const { return follows_; }

  void show_all() { *this = {}; }
  void show_last(double length) {
    show_all();
    length_ = length;
  }
  /// `factor` < 1 shows less. What is at this share of the range stays there; what ends with the newest goes on doing
  /// so when the share is next to 1.
  void zoom(double share, double factor, const TimeRange& known) {
    constexpr double shortest = 1e-6;  // of what is known
    constexpr double newest = 0.95;
    const TimeRange before = range(known);
    const double length = std::max(factor * before.length(), shortest * known.length());
    if (!(length < known.length())) return show_all();
    const bool stays_at_end = follows_ && share > newest;
    place(before.at(share) - share * length, length, known);
    follows_ = follows_ || stays_at_end;
  }
  /// Moves what is shown by a share of its length, as far as there is anything.
  void pan(double share, const TimeRange& known) {
    const TimeRange before = range(known);
    if (length_) place(before.from + share * before.length(), before.length(), known);
  }

 private:
  void place(double from, double length, const TimeRange& known) {
    length_ = length;
    from_ = std::clamp(from, known.from, known.to - length);
    follows_ = from >= known.to - length;
  }

  std::optional<double> length_;
  double from_ = 0;
  bool follows_ = true;
};

}  // namespace pliant_viewer
