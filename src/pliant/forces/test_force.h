#pragma once
#include <vector>

#include "pliant/core/options.h"
#include "pliant/forces/force.h"

namespace pliant {

/// A constant force [N] on vertices for the steps (frames) in [begin, end); thesis Sec. 6.2.
class TestForce final : public Force {
 public:
  static constexpr std::int64_t forever = std::numeric_limits<std::int64_t>::max();

  /// Vertices with the indices of the simulation; one force for all, or one for each. Throws Error(input) on a force
  /// that is not finite, a wrong number of forces, or an empty range.
  TestForce(std::vector<Index> vertices, Points forces, std::int64_t begin = 0, std::int64_t end = forever);

  std::string_view type() const override { return "test_force"; }
  void add_to(Positions& forces, const StateView& state, Real time_step) override;
  std::optional<Index> vertex_out_of_range(Index vertex_count) const override;

  bool is_active(std::int64_t step) const { return begin_ <= step && step < end_; }
  const std::vector<Index>& vertices() const { return vertices_; }

 private:
  std::vector<Index> vertices_;
  Points forces_;
  std::int64_t begin_;
  std::int64_t end_;
};

}  // namespace pliant
