#pragma once
// Verdicts, and measured figures beside known ones.
#include <string>
#include <vector>

#include "report/report.h"

namespace pliant_experiments {

/// A claim that holds or does not.
pliant_report::Claim claim(std::string text, std::string by, bool holds, std::string evidence);
/// A figure that nobody has claimed, or a claim that cannot be judged by one figure.
pliant_report::Claim reported(std::string text, std::string by, std::string evidence);

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
