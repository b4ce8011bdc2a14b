#include "bench/results.h"

#include <algorithm>
#include <stdexcept>

namespace pliant_bench {

const Phase& WorkloadResult::phase(std::string_view name) const {
  const auto found = std::ranges::find(phases, name, &Phase::name);
  if (found == phases.end()) throw std::logic_error("the bench has no phase " + std::string(name));
  return *found;
}

const BaselineResult* WorkloadResult::baseline(std::string_view name) const {
  const auto found = std::ranges::find(baselines, name, &BaselineResult::name);
  return found == baselines.end() ? nullptr : &*found;
}

const Level* BenchResult::level_of(std::int64_t bytes) const {
  for (const Level& level : levels) {
    if (level.bytes == 0 || bytes <= level.bytes) return &level;
  }
  return levels.empty() ? nullptr : &levels.back();
}

}  // namespace pliant_bench
