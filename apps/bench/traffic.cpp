#include "bench/traffic.h"

#include <algorithm>

namespace pliant_bench {
namespace {

using namespace pliant;

constexpr std::int64_t real = sizeof(Real);
constexpr std::int64_t index = sizeof(Index);
constexpr std::int64_t point = 3 * real;
constexpr std::int64_t offset = sizeof(std::size_t);

std::int64_t size_of(std::size_t count) {
  return static_cast<std::int64_t>(count);
}

/// Sums over all groups.
struct Sums {
  std::int64_t constraint_data = 0;
  std::int64_t slots = 0;
  std::int64_t gathered = 0;  // entries of the reductions that are not zero
};

void add_group(ConstraintGroup& group, Sums& sums) {
  const GroupShape shape = group.shape();
  sums.constraint_data += index * size_of(group.stencil().size());
  sums.constraint_data += real * size_of(group.reduction().size() + group.measure().size());
  sums.constraint_data += real * size_of(group.mutable_numbers().size());  // the fields
  sums.slots += point * shape.count * shape.rows;
  sums.gathered += std::ranges::count_if(group.reduction(), [](Real c) { return c != 0; });
}

}  // namespace

Traffic traffic_of(const Simulation& simulation, const SystemInfo& info) {
  Sums sums;
  for (const auto& [id, group] : simulation.groups()) {
    for (const auto& part : group.set.parts) add_group(*part, sums);
  }
  const std::int64_t m = simulation.state().vertex_count();
  const std::int64_t gather_lists = sums.gathered * (real + 4) + (m + 1) * offset;
  Traffic traffic;
  traffic.projections = sums.constraint_data + m * point + sums.slots;
  // q, s, M/h² and the mark of held vertices in, r out
  traffic.gather = gather_lists + sums.slots + m * (2 * point + real + 1 + point);
  const std::int64_t lanes = 4 * (info.precision == Precision::mixed ? 4 : 8);  // of a vertex in a sweep
  traffic.sweep = info.sweep_bytes + m * (2 * lanes + point + index);
  traffic.update = 3 * m * point;
  traffic.working_set =
      sums.constraint_data + sums.slots + gather_lists + info.sweep_bytes + m * (4 * point + lanes + real + 1 + index);
  return traffic;
}

}  // namespace pliant_bench
