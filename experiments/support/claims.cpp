#include "support/claims.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace pliant_experiments {

using pliant_report::Claim;
using pliant_report::Verdict;

Claim claim(std::string text, std::string by, bool holds, std::string evidence) {
  return {std::move(text), std::move(by), holds ? Verdict::holds : Verdict::fails, std::move(evidence)};
}

Claim reported(std::string text, std::string by, std::string evidence) {
  return {std::move(text), std::move(by), Verdict::reported, std::move(evidence)};
}

Claim at_most(std::string text, const Spread& measured, double limit, std::string evidence) {
  const bool is_in_noise = measured.low <= limit && measured.high > limit;
  if (is_in_noise) evidence += "; the limit lies within the noise of repeats";
  evidence += fmt::format(" (middle half of repeats {:.2f} to {:.2f})", measured.low, measured.high);
  const Verdict verdict = is_in_noise ? Verdict::reported : measured.high <= limit ? Verdict::holds : Verdict::fails;
  return {std::move(text), "", verdict, std::move(evidence)};
}

std::string times_text(const Spread& a, const Spread& b, const char* unit) {
  const bool is_in_noise = a.low <= b.high && b.low <= a.high;
  return fmt::format("{:.2f} in place of {:.2f} {}{}", a.middle, b.middle, unit,
                     is_in_noise ? ", a difference within the noise" : "");
}

double Comparison::Row::difference() const {
  return std::abs(measured - known) / std::abs(known);
}

void Comparison::add(std::string what, double measured, double known) {
  rows_.push_back({std::move(what), measured, known});
}

Claim Comparison::claim(std::string text) const {
  const auto most = std::ranges::max_element(rows_, {}, &Row::difference);
  const auto agreeing = std::ranges::count_if(rows_, [&](const Row& row) { return row.difference() <= share_; });
  return pliant_experiments::claim(
      std::move(text), "an independent program", agreeing == static_cast<std::ptrdiff_t>(rows_.size()),
      fmt::format("{} of {} figures within {:.0f} %; the farthest off, {}: {:.4g} against {:.4g} ({:.1f} %)", agreeing,
                  rows_.size(), 100 * share_, most->what, most->measured, most->known, 100 * most->difference()));
}

pliant_report::Table Comparison::table(std::string caption) const {
  pliant_report::Table table{std::move(caption), {"", "measured here", "independent program", "difference [%]"}, {}};
  for (const Row& row : rows_) {
    table.rows.push_back({row.what, fmt::format("{:.4g}", row.measured), fmt::format("{:.4g}", row.known),
                          fmt::format("{:.1f}", 100 * row.difference())});
  }
  return table;
}

}  // namespace pliant_experiments
