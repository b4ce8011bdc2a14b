// A group of a user's own that projects all of its constraints at the beginning of a local step.
#include <atomic>
#include <stdexcept>

#include <doctest/doctest.h>

#include "../mesh/meshes.h"
#include "../simulation/run.h"
#include "pliant/constraints/builtin.h"
#include "pliant/mesh/shapes.h"

namespace test_all_at_once {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Real pull = 50;  // N/m

struct Counts {
  int begun = 0;
  int ended = 0;
  std::atomic<int> outside = 0;  // calls of project() outside of a local step
};

enum class Fails { never, at_begin, in_between };

/// Each constraint pulls its vertex to the origin.
class PullAtOnce final : public ConstraintGroup {
 public:
  PullAtOnce(Index count, Counts& counts, Fails fails = Fails::never)
      : ConstraintGroup(pull), counts_(counts), fails_(fails), ones_(at(count), 1), found_(3 * at(count)) {
    for (Index i = 0; i < count; ++i) stencil_.push_back(i);
  }

  std::string_view type() const override { return "pull_at_once"; }
  GroupShape shape() const override { return {static_cast<Index>(stencil_.size()), 1, 1}; }
  std::span<const Index> stencil() const override { return stencil_; }
  std::span<const Real> reduction() const override { return ones_; }
  std::span<const Real> rest_measure() const override { return ones_; }

  void begin_local_step(const Positions& q) override {
    if (fails_ == Fails::at_begin) throw std::runtime_error("at the beginning");
    ++counts_.begun;
    is_open_ = true;
    for (std::size_t i = 0; i < found_.size(); ++i) found_[i] = -stiffness() * q.data()[i];
  }
  void end_local_step() noexcept override {
    ++counts_.ended;
    is_open_ = false;
  }
  Real project(const Positions& q, std::span<Real> out, Index begin, Index end) const override {
    if (fails_ == Fails::in_between) throw std::runtime_error("in between");
    if (!is_open_) ++counts_.outside;
    Real energy = 0;
    for (std::size_t i = 3 * at(begin); i < 3 * at(end); ++i) {
      const Real x = q.data()[i];
      out[i - 3 * at(begin)] = is_open_ ? found_[i] : -stiffness() * x;
      energy += stiffness() / 2 * x * x;
    }
    return energy;
  }

 private:
  Counts& counts_;
  Fails fails_;
  bool is_open_ = false;
  std::vector<Index> stencil_;
  std::vector<Real> ones_;
  std::vector<Real> found_;
};

Simulation sheet(int threads) {
  Simulation simulation({.iterations = 5, .precision = Precision::double_, .threads = threads});
  const BodyId body = simulation.add_body(grid({.columns = 40, .rows = 40}), Mass::per_vertex(0.1));
  simulation.add(body, EdgeSpring{.stiffness = 100});
  return simulation;
}

void add(Simulation& simulation, std::unique_ptr<ConstraintGroup> group) {
  ConstraintSet set;
  set.count = group->shape().count;
  set.batches.push_back(std::move(group));
  simulation.add_set(BodyId{0}, std::move(set), "pull");
}

}  // namespace

TEST_CASE("a group that projects at the beginning of the local step moves the body as one that does so in chunks") {
  for (const int threads : {1, 2}) {
    Counts counts;
    Simulation at_once = sheet(threads);
    add(at_once, std::make_unique<PullAtOnce>(1600, counts));
    Simulation in_chunks = sheet(threads);
    std::vector<Index> vertices;
    for (Index i = 0; i < 1600; ++i) vertices.push_back(i);
    in_chunks.add(BodyId{0}, Position{.on = vertices, .hold = Hold::soft, .stiffness = pull, .targets = Vec3(0, 0, 0)});
    advance(at_once, 3);
    advance(in_chunks, 3);
    CHECK(largest_difference(at_once.state().positions, in_chunks.state().positions) < 1e-12);
    CHECK(counts.begun >= 15);
    CHECK(counts.begun == counts.ended);
    CHECK(counts.outside == 0);
  }
}

TEST_CASE("every local step that was begun is ended, also where a group throws") {
  for (const Fails fails : {Fails::at_begin, Fails::in_between}) {
    Counts counts, of_failing;
    Simulation simulation = sheet(2);
    add(simulation, std::make_unique<PullAtOnce>(1600, counts));
    add(simulation, std::make_unique<PullAtOnce>(1600, of_failing, fails));
    const Positions before = simulation.state().positions;
    CHECK_THROWS_AS(simulation.step(), std::runtime_error);
    CHECK(simulation.state().positions == before);
    CHECK(counts.begun == 1);
    CHECK(counts.ended == 1);
    CHECK(of_failing.begun == of_failing.ended);
    CHECK(of_failing.begun == (fails == Fails::in_between ? 1 : 0));
  }
}

}  // namespace test_all_at_once
