#include <cmath>
#include <numeric>

#include <doctest/doctest.h>

#include "../core/random.h"
#include "../mesh/meshes.h"
#include "pliant/pliant.h"
#include "pliant/solver/factorization/factorization.h"
#include "pliant/solver/factorization/panel_factor.h"
#include "pliant/solver/global_step.h"

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
    const Index neighbours = (i > 0) + (i + 1 < side) + (j > 0) + (j + 1 < side);
    matrix.rows.push_back(v);
    matrix.values.push_back(mass + stiffness * neighbours + (v == 0 ? pin : 0));
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

template <class T>
Positions solution(const Factorization& factorization, const Positions& b, int threads, Index* tasks = nullptr) {
  PanelFactor<T> panels;
  panels.lay_out(factorization.factor());
  panels.fill(factorization.factor(), 1e3);
  ThreadPool pool(threads);
  Positions x(b.rows(), 3);
  panels.solve(b, 1, x, pool);
  if (tasks != nullptr) *tasks = panels.task_count();
  return x;
}

struct Trial {
  GlobalStep step;
  FreeParts parts;
  std::vector<Real> weights;
  ThreadPool threads{2};
  SetUpTimes times;

  Trial(const LowerMatrix& matrix, Precision precision, Real mass, Index free_size) {
    weights.assign(static_cast<std::size_t>(matrix.size()), mass);
    for (Index v = 0; free_size > 0 && v < matrix.size(); v += free_size) {
      for (Index i = 0; i < free_size; ++i) parts.vertices.push_back(v + i);
      parts.starts.push_back(parts.vertices.size());
    }
    step.set_factorization(make_factorization(Backend::automatic));
    step.analyze(matrix);
    step.factorize(matrix, precision, weights, parts, threads, times);
  }
  Positions solve(const Positions& r) {
    Positions x(r.rows(), 3);
    step.solve(r, r.cwiseAbs().maxCoeff(), x, threads);
    return x;
  }
};

}  // namespace

TEST_CASE("subtrees are swept by any number of threads to the same bits") {
  const LowerMatrix matrix = grid_matrix(90, 10, 100);
  for (const Backend backend : {Backend::automatic, Backend::eigen}) {
    const auto factorization = make_factorization(backend);
    factorization->analyze(matrix);
    factorization->factorize(matrix);
    Random random;
    const Positions b = random.positions(matrix.size(), 1);
    Index tasks = 0;
    const Positions once = solution<double>(*factorization, b, 1, &tasks);
    if (factorization->name() == "cholmod") CHECK(tasks > 4);
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

TEST_CASE("tasks are subtrees that follow each other, and the rest is above them") {
  // A complete binary tree of panels in postorder.
  std::vector<PanelShape> panels;
  const auto add = [&](auto&& self, int depth) -> Index {
    std::array<Index, 2> children = {-1, -1};
    if (depth > 0) {
      for (Index& child : children) child = self(self, depth - 1);
    }
    const auto place = static_cast<Index>(panels.size());
    panels.push_back({-1, 1000});
    for (const Index child : children) {
      if (child >= 0) panels[static_cast<std::size_t>(child)].parent = place;
    }
    return place;
  };
  add(add, 9);
  const std::vector<PanelTask> tasks = divide(panels);
  CHECK(tasks.size() >= 16);
  CHECK(tasks.size() <= 128);
  Index last = 0;
  for (const PanelTask& task : tasks) {
    CHECK(task.begin >= last);
    CHECK(task.end > task.begin);
    last = task.end;
    for (Index p = task.begin; p < task.end; ++p) {
      const Index parent = panels[static_cast<std::size_t>(p)].parent;
      const bool is_inside = parent >= task.begin && parent < task.end;
      const bool is_in_another = std::ranges::any_of(
          tasks, [&](const PanelTask& other) { return parent >= other.begin && parent < other.end; });
      CHECK((is_inside || !is_in_another));
    }
  }
  CHECK(last < static_cast<Index>(panels.size()));
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

TEST_CASE("parts that nothing holds move as a whole exactly as the forces on them say") {
  const Real mass = 1e-3 / 64;  // 1 g at h = 8 s
  const LowerMatrix matrix = grid_matrix(20, mass, 1e7, 3);
  Trial trial(matrix, Precision::mixed, mass, 400);
  CHECK(trial.step.precision() == Precision::mixed);
  Random random;
  const Positions r = random.positions(matrix.size(), 1);
  const Positions x = trial.solve(r);
  for (std::size_t part = 0; part < 3; ++part) {
    Vec3 force = Vec3::Zero(), moved = Vec3::Zero();
    for (const Index v : trial.parts.part(part)) {
      force += r.row(v).transpose();
      moved += mass * x.row(v).transpose();
    }
    CHECK((force - moved).norm() < 1e-9 * r.norm());
  }
}
