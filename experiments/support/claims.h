#pragma once
// Verdicts, and measured figures beside known ones.
#include <string>
#include <vector>

#include "report/report.h"
#include "support/statistics.h"

namespace pliant_experiments {

/// A claim that holds or does not.
pliant_report::Claim claim(std::string text, std::string by, bool holds, std::string evidence);
/// A figure that nobody has claimed, or a claim that cannot be judged by one figure.
pliant_report::Claim reported(std::string text, std::string by, std::string evidence);

/// A claim that a figure that was measured several times, as a time is, is at most that large: it holds where three of
/// four repeats are, does not where three of four are not, and is otherwise reported, the difference lying within the
/// noise.
pliant_report::Claim at_most(std::string text, const Spread& measured, double limit, std::string evidence);

/// "3.1 in place of 2.5 ms", and that it is within the noise where the middle halves of the repeats meet.
std::string times_text(const Spread& a, const Spread& b, const char* unit);

/// Measured figures and those of another, independent program for the same set-up.
class Comparison {
 public:
  /// `share`: by which the figures may differ.
  explicit Comparison(double share) : share_(share) {}

  void add(std::string what, double measured, double known);
  /// Holds where no figure differs by more than the share.
  pliant_report::Claim claim(std::string text) const;
  pliant_report::Table table(std::string caption) const;

 private:
  struct Row {
    std::string what;
    double measured, known;
    double difference() const;
  };
  double share_;
  std::vector<Row> rows_;
};

}  // namespace pliant_experiments
