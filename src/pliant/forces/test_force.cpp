#include "pliant/forces/test_force.h"

namespace pliant {

TestForce::TestForce(std::vector<Index> vertices, Points forces, std::int64_t begin, std::int64_t end)
    : vertices_(std::move(vertices)), forces_(std::move(forces)), begin_(begin), end_(end) {
  detail::OptionChecker{"test_force"}(OptionInfo{"force", "N", ""}, forces_);
  if (forces_.empty() || (forces_.each() && forces_.list().size() != vertices_.size())) {
    fail_input("test_force: " + std::to_string(forces_.list().size()) + " forces for " +
               std::to_string(vertices_.size()) + " vertices; give one for all, or one each");
  }
  if (begin_ < 0 || begin_ >= end_) {
    fail_input("test_force: the frames [" + std::to_string(begin_) + ", " + std::to_string(end_) +
               ") are none; give a first frame from 0 and a later end");
  }
}

void TestForce::add_to(Positions& forces, const StateView& state, Real) {
  if (!is_active(state.step)) return;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    forces.row(vertices_[i]) += forces_[static_cast<Index>(i)].transpose();
  }
}

std::optional<Index> TestForce::vertex_out_of_range(Index vertex_count) const {
  for (const Index vertex : vertices_) {
    if (vertex < 0 || vertex >= vertex_count) return vertex;
  }
  return std::nullopt;
}

}  // namespace pliant
