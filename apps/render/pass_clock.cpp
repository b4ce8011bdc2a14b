#include "render/pass_clock.h"

#include <algorithm>

#include <epoxy/gl.h>
#include <fmt/format.h>

namespace pliant_render {
namespace {

/// In milliseconds.
double median(std::vector<double> seconds) {
  if (seconds.size() > 1) seconds.erase(seconds.begin());
  std::ranges::sort(seconds);
  const std::size_t half = seconds.size() / 2;
  return 1e3 * (seconds.size() % 2 == 1 ? seconds[half] : (seconds[half - 1] + seconds[half]) / 2);
}

}  // namespace

void PassClock::begin() {
  glFinish();
  watch_.lap();
  ++pictures_;
}

void PassClock::end(std::string_view pass) {
  glFinish();
  auto known = std::ranges::find(passes_, pass, &Pass::name);
  if (known == passes_.end()) known = passes_.insert(known, {std::string(pass)});
  known->seconds.resize(pictures_);
  known->seconds.back() += watch_.lap();
}

std::string PassClock::text() const {
  std::vector<double> sums(pictures_);
  std::string table;
  for (const Pass& pass : passes_) {
    std::vector<double> seconds = pass.seconds;
    seconds.resize(pictures_);
    for (std::size_t i = 0; i < pictures_; ++i) sums[i] += seconds[i];
    table += fmt::format("{:>9.2f}  {}\n", median(seconds), pass.name);
  }
  if (sums.empty()) return "";
  return fmt::format("      ms  pass, in the median of {} pictures\n{}{:>9.2f}  in all\n",
                     std::max<std::size_t>(pictures_ - 1, 1), table, median(sums));
}

}  // namespace pliant_render
