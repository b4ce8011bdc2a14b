#include <cmath>
#include <numeric>

#include <doctest/doctest.h>

#include "../core/random.h"
#include "../mesh/meshes.h"
#include "pliant/pliant.h"
#include "pliant/solver/global/factorization/factorization.h"
#include "pliant/solver/global/factorization/panel_factor.h"
#include "pliant/solver/global/global_step.h"

namespace test_global_step {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// mass on the diagonal plus the differences along the edges of a square grid, and of a few such grids in a row.
LowerMatrix grid_matrix(Index side, Real mass, Real stiffness, Index copies = 1, Real pin = 0) {
  LowerMatrix matrix;
  const Index size = side * side;
  for (Index v = 0; v < copies * size; ++v) {
    const Index i = v % side;
    const Index j = v % size / side;
    const Index neighbors = (i > 0) + (i + 1 < side) + (j > 0) + (j + 1 < side);
    matrix.rows.push_back(v);
    matrix.values.push_back(mass + stiffness * neighbors + (v == 0 ? pin : 0));
    for (const auto& [is_there, other] : {std::pair{i + 1 < side, v + 1}, {j + 1 < side, v + side}}) {
      if (!is_there) continue;
      matrix.rows.push_back(other);
      matrix.values.push_back(-stiffness);
    }
    matrix.column_starts.push_back(static_cast<Index>(matrix.rows.size()));
  }
  return matrix;
}

Positions multiply(const LowerMatrix& Y, const Positions& x) {
  Positions y = Positions::Zero(x.rows(), 3);
  for (Index c = 0; c < Y.size(); ++c) {
    for (Index e = Y.column_starts[static_cast<std::size_t>(c)]; e < Y.column_starts[static_cast<std::size_t>(c) + 1];
         ++e) {
      const Index r = Y.rows[static_cast<std::size_t>(e)];
      y.row(r) += Y.values[static_cast<std::size_t>(e)] * x.row(c);
      if (r != c) y.row(c) += Y.values[static_cast<std::size_t>(e)] * x.row(r);
    }
  }
  return y;
}

struct Divided {
  Index tasks = 0;
  Index stages = 0;
};

template <class T>
Positions solution(const Factorization& factorization, const Positions& b, int threads, Divided* divided = nullptr) {
  PanelFactor<T> panels;
  panels.lay_out(factorization.factor());
  ThreadPool pool(threads);
  panels.fill(factorization.factor(), 1e3, pool);
  Positions x(b.rows(), 3);
  panels.solve(b, 1, x, pool);
  if (divided != nullptr) *divided = {panels.task_count(), panels.stage_count()};
  return x;
}

struct Trial {
  GlobalStep step;
  Components components;
  std::vector<Real> weights;
  ThreadPool threads{2};
  SetUpTimes times;

  Trial(const LowerMatrix& matrix, Precision precision, Real mass, Index free_size) {
    weights.assign(static_cast<std::size_t>(matrix.size()), mass);
    for (Index v = 0; free_size > 0 && v < matrix.size(); v += free_size) {
      for (Index i = 0; i < free_size; ++i) components.vertices.push_back(v + i);
      components.starts.push_back(components.vertices.size());
    }
    step.set_factorization(make_factorization(Backend::automatic));
    step.analyze(matrix);
    step.factorize(matrix, precision, weights, components, threads, times);
  }
  Positions solve(Positions r) {
    Positions x(r.rows(), 3);
    step.solve(r, r.cwiseAbs().maxCoeff(), x, threads);
    return x;
  }
};

}  // namespace

TEST_CASE("subtrees are solved by any number of threads to the same bits, in one stage or in several") {
  for (const auto& [size, backend] :
       {std::pair(90, Backend::automatic), std::pair(90, Backend::eigen), std::pair(260, Backend::automatic)}) {
    const LowerMatrix matrix = grid_matrix(size, 10, 100);
    const auto factorization = make_factorization(backend);
    factorization->analyze(matrix);
    factorization->factorize(matrix);
    Random random;
    const Positions b = random.positions(matrix.size(), 1);
    Divided divided;
    const Positions once = solution<double>(*factorization, b, 1, &divided);
    if (factorization->name() == "cholmod") {
      CHECK(divided.tasks > 4);
      CHECK((divided.stages > 1) == (size > 90));
    }
    CHECK((multiply(matrix, once) - b).cwiseAbs().maxCoeff() < 1e-12);
    const Positions once_single = solution<float>(*factorization, b, 1);
    CHECK((multiply(matrix, once_single) - b).cwiseAbs().maxCoeff() < 1e-4);
    for (const int threads : {2, 3, 8}) {
      CAPTURE(threads);
      CHECK(solution<double>(*factorization, b, threads) == once);
      CHECK(solution<float>(*factorization, b, threads) == once_single);
    }
  }
}

namespace {

/// A complete binary tree of panels in postorder.
std::vector<PanelShape> binary_tree(int depth, std::int64_t weight) {
  std::vector<PanelShape> panels;
  const auto add = [&](auto&& self, int below) -> Index {
    std::array<Index, 2> children = {-1, -1};
    if (below > 0) {
      for (Index& child : children) child = self(self, below - 1);
    }
    const auto place = static_cast<Index>(panels.size());
    panels.push_back({-1, weight});
    for (const Index child : children) {
      if (child >= 0) panels[static_cast<std::size_t>(child)].parent = place;
    }
    return place;
  };
  add(add, depth);
  return panels;
}

/// Which stage and task each panel is in, by numbers that grow with the stage; the rest comes last.
std::vector<std::size_t> places(const std::vector<PanelStage>& stages, std::size_t panel_count) {
  std::vector<std::size_t> place(panel_count, 1000 * stages.size());
  for (std::size_t s = 0; s < stages.size(); ++s) {
    Index last = 0;
    for (std::size_t i = 0; i < stages[s].size(); ++i) {
      const PanelTask& task = stages[s][i];
      CHECK(task.begin >= last);
      last = task.end;
      REQUIRE(!task.ranges.empty());
      Index next = task.begin;
      for (const PanelRange& range : task.ranges) {
        CHECK(range.begin >= next);
        REQUIRE(range.end > range.begin);
        next = range.end;
        for (Index p = range.begin; p < range.end; ++p) {
          CHECK(place[static_cast<std::size_t>(p)] == 1000 * stages.size());  // in no other task
          place[static_cast<std::size_t>(p)] = 1000 * s + i;
        }
      }
      CHECK(next == task.end);
    }
  }
  return place;
}

}  // namespace

TEST_CASE("tasks are subtrees, and what is above them is in later stages and the rest") {
  for (const std::int64_t weight : {1000, 100'000}) {
    const std::vector<PanelShape> panels = binary_tree(9, weight);
    const std::vector<PanelStage> stages = divide(panels);
    CHECK(stages.size() == (weight == 1000 ? 1 : 3));  // where panels are small, later stages are not worth it
    CHECK(stages[0].size() >= 16);
    CHECK(stages[0].size() <= 128);
    const std::vector<std::size_t> place = places(stages, panels.size());
    for (std::size_t p = 0; p < panels.size(); ++p) {
      if (panels[p].parent < 0) continue;
      const std::size_t above = place[static_cast<std::size_t>(panels[p].parent)];
      CHECK((above == place[p] || above / 1000 > place[p] / 1000));
    }
    CHECK(place.back() == 1000 * stages.size());
    CHECK(std::ranges::count(place, 1000 * stages.size()) < (weight == 1000 ? 128 : 8));
  }
  std::vector<PanelShape> panels = binary_tree(9, 1000);
  std::swap(panels[0].parent, panels[1].parent);
  panels[3].parent = 1;  // no tree in postorder
  CHECK(divide(panels).empty());
  CHECK(divide({}).empty());
}

TEST_CASE("single precision leaves a small share of an error, which is estimated") {
  const LowerMatrix matrix = grid_matrix(30, 3600, 1000, 1, 1e6);
  Trial trial(matrix, Precision::mixed, 3600, 0);
  CHECK(trial.step.precision() == Precision::mixed);
  CHECK(trial.step.contraction() > 0);
  CHECK(trial.step.contraction() < 1e-4);
  // What it says is what happens.
  Random random;
  const Positions exact = random.positions(matrix.size(), 1);
  Positions x = Positions::Zero(exact.rows(), 3);
  Real before = exact.norm();
  for (int i = 0; i < 2; ++i) {
    x += trial.solve(multiply(matrix, exact - x));
    CHECK((exact - x).norm() < 10 * trial.step.contraction() * before);
    before = (exact - x).norm();
  }
}

TEST_CASE("where single precision would cost iterations, double panels are taken") {
  const LowerMatrix matrix = grid_matrix(40, 1e-6, 1e7, 1, 1e-2);
  Trial trial(matrix, Precision::mixed, 1e-6, 0);
  CHECK(trial.step.contraction() > 0.01);
  CHECK(trial.step.precision() == Precision::double_);
  Trial asked(matrix, Precision::double_, 1e-6, 0);
  CHECK(asked.step.contraction() == 0);
  Random random;
  const Positions r = random.positions(matrix.size(), 1);
  CHECK(trial.solve(r) == asked.solve(r));
}

TEST_CASE("components that nothing holds move as a whole exactly as the forces on them say") {
  const Real mass = 1e-3 / 64;  // 1 g at h = 8 s
  const LowerMatrix matrix = grid_matrix(20, mass, 1e7, 3);
  Trial trial(matrix, Precision::mixed, mass, 400);
  CHECK(trial.step.precision() == Precision::mixed);
  Random random;
  const Positions r = random.positions(matrix.size(), 1);
  const Positions x = trial.solve(r);
  for (std::size_t i = 0; i < 3; ++i) {
    Vec3 force = Vec3::Zero(), moved = Vec3::Zero();
    for (const Index v : trial.components.component(i)) {
      force += r.row(v).transpose();
      moved += mass * x.row(v).transpose();
    }
    CHECK((force - moved).norm() < 1e-9 * r.norm());
  }
}

}  // namespace test_global_step
