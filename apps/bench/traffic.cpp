#include "bench/traffic.h"

#include <algorithm>

namespace pliant_bench {
namespace {

using namespace pliant;

constexpr std::int64_t real = sizeof(Real);
constexpr std::int64_t index = sizeof(Index);
constexpr std::int64_t point = 3 * real;

std::int64_t size_of(std::size_t count) {
  return static_cast<std::int64_t>(count);
}

/// What the projections must read of a group. Its reduction is not counted where it is (−1, 1), which kernels know, and
/// of each row else one coefficient less, as rows sum to zero.
std::int64_t bytes_of(ConstraintGroup& group) {
  const bool is_difference = std::ranges::all_of(group.reduction(), [](Real c) { return c == 1 || c == -1; });
  const GroupShape shape = group.shape();
  const auto rows = static_cast<std::size_t>(shape.count) * static_cast<std::size_t>(shape.rows);
  const std::size_t reduction = is_difference ? 0 : group.reduction().size() - rows;
  return index * size_of(group.stencil().size()) + real * size_of(reduction + group.rest_measure().size()) +
         real * size_of(group.parameters().size());  // the fields
}

}  // namespace

Traffic traffic_of(const Simulation& simulation, const SystemInfo& info) {
  std::int64_t constraints = 0;
  for (const auto& [id, group] : simulation.groups()) {
    for (const auto& batch : group.set.batches) constraints += bytes_of(*batch);
  }
  const std::int64_t m = simulation.state().vertex_count();
  Traffic traffic;
  traffic.projections = constraints + m * point + info.local_list_bytes + info.partial_bytes;
  // q, s, M/h² and the mark of pinned vertices in, r out
  traffic.gather = info.partial_list_bytes + info.partial_bytes + m * (2 * point + real + 1 + point);
  const std::int64_t lanes = 4 * (info.precision == Precision::mixed ? 4 : 8);  // of a vertex in a substitution
  traffic.substitution = info.substitution_bytes + m * (2 * lanes + point + index);
  traffic.backward = traffic.substitution - info.substitution_bytes + info.backward_bytes;
  traffic.update = m * point;  // backward substitution adds to it where it writes
  traffic.working_set = constraints + info.local_list_bytes + info.partial_bytes + info.partial_list_bytes +
                        info.substitution_bytes + m * (4 * point + lanes + real + 1 + index);
  return traffic;
}

}  // namespace pliant_bench
