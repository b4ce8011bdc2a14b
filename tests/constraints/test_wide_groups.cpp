// Groups of a user's own whose constraints have many rows or many vertices.
#include <doctest/doctest.h>

#include "../mesh/meshes.h"
#include "../simulation/run.h"
#include "pliant/constraints/builtin.h"
#include "pliant/mesh/shapes.h"

namespace test_wide_groups {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Real pull = 50;  // N/m

/// One constraint that pulls the first vertices to the origin, each by a row of its own.
class PullAll final : public ConstraintGroup {
 public:
  explicit PullAll(int count) : PullAll(count, count) {}
  PullAll(int vertices, int rows)
      : ConstraintGroup(pull),
        shape_{1, vertices, rows},
        reduction_(static_cast<std::size_t>(vertices) * static_cast<std::size_t>(rows), 0) {
    for (Index i = 0; i < vertices; ++i) stencil_.push_back(i);
    for (int i = 0; i < std::min(vertices, rows); ++i) reduction_[static_cast<std::size_t>(i * vertices + i)] = 1;
  }

  std::string_view type() const override { return "pull_all"; }
  GroupShape shape() const override { return shape_; }
  std::span<const Index> stencil() const override { return stencil_; }
  std::span<const Real> reduction() const override { return reduction_; }
  std::span<const Real> rest_measure() const override { return {&one_, 1}; }
  Real project(const Positions& q, std::span<Real> out, Index, Index) const override {
    Real energy = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(3 * shape_.rows); ++i) {
      out[i] = -stiffness() * q.data()[i];
      energy += stiffness() / 2 * q.data()[i] * q.data()[i];
    }
    return energy;
  }

 private:
  GroupShape shape_;
  std::vector<Index> stencil_;
  std::vector<Real> reduction_;
  Real one_ = 1;
};

Simulation sheet(Index side) {
  Simulation simulation({.iterations = 5, .precision = Precision::double_});
  const BodyId body = simulation.add_body(grid({.columns = side, .rows = side}), Mass::per_vertex(0.1));
  simulation.add(body, EdgeSpring{.stiffness = 100});
  return simulation;
}

void add(Simulation& simulation, std::unique_ptr<ConstraintGroup> group) {
  ConstraintSet set;
  set.batches.push_back(std::move(group));
  set.count = 1;
  simulation.add_set(BodyId{0}, std::move(set), "pull_all");
}

}  // namespace

TEST_CASE("one constraint with a row for each vertex moves them as so many constraints do") {
  for (const int count : {1, 2, 64, 65, 100}) {
    CAPTURE(count);
    Simulation together = sheet(10);
    add(together, std::make_unique<PullAll>(count));
    Simulation apart = sheet(10);
    std::vector<Index> vertices;
    for (Index i = 0; i < count; ++i) vertices.push_back(i);
    apart.add(BodyId{0}, Position{.on = vertices, .hold = Hold::soft, .stiffness = pull, .targets = Vec3(0, 0, 0)});
    advance(together, 2);
    advance(apart, 2);
    CHECK(largest_difference(together.state().positions, apart.state().positions) < 1e-12);
  }
}

TEST_CASE("constraints that the local step could not hold are refused, whoever made them") {
  Simulation simulation = sheet(70);
  const auto refusal = [&](int vertices, int rows) {
    return error_of([&] { add(simulation, std::make_unique<PullAll>(vertices, rows)); });
  };
  CHECK(contains(refusal(max_stencil + 1, 1), "4097 vertices, of 4096 at most; split them"));
  CHECK(contains(refusal(2, max_reduction_rows + 1), "4097 rows, of 4096 at most; split the constraint"));
  advance(simulation, 1);
  CHECK(simulation.state().positions.allFinite());
}

}  // namespace test_wide_groups
