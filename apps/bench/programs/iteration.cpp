// One iteration and the set-up of the engine, against what a user would write with Eigen and with CHOLMOD, in one
// process and on one thread: ratios within a run, medians of repeats that take turns.
//
//     bench_iteration [repeats]
#include <algorithm>
#include <string>

#include <Eigen/SparseCholesky>
#include <fmt/format.h>

#include "bench/baselines.h"
#include "pliant/core/stopwatch.h"
#include "pliant/pliant.h"
#ifdef PLIANT_HAS_CHOLMOD
#include <cholmod.h>
#endif

namespace {

using namespace pliant;
using Sparse = Eigen::SparseMatrix<Real>;

struct Workload {
  std::string name;
  Mesh mesh;
  bool with_bending;
  Index iterations;
};

/// A square curtain of n × n vertices of 1 kg, its two upper corners pinned softly.
Workload curtain(std::string name, Index n, Index iterations, bool with_bending) {
  return {std::move(name), grid({.columns = n, .rows = n, .size = {1, 1}}), with_bending, iterations};
}

Workload tetrahedra(std::string name) {
  return {std::move(name), bar({.cells = {40, 10, 10}, .size = {4, 1, 1}, .cut = TetrahedronCut::five}), false, 10};
}

Simulation simulate(const Workload& workload, Backend backend) {
  Simulation simulation({.iterations = workload.iterations, .backend = backend, .threads = 1});
  const BodyId body = simulation.add_body(workload.mesh, Mass::per_vertex(1));
  simulation.add(Gravity{});
  if (workload.mesh.tetrahedra.empty()) {
    const auto side = static_cast<Index>(std::lround(std::sqrt(workload.mesh.vertex_count())));
    const Index last = workload.mesh.vertex_count() - 1;
    simulation.add(body, EdgeSpring{.stiffness = 1e3});
    simulation.add(body, Position{.on = {last - side + 1, last}, .hold = Hold::soft, .stiffness = 1e6});
    if (workload.with_bending) simulation.add(body, Bending{.stiffness = 1e-3});
  } else {
    simulation.add(body, TetrahedronStrain{.stiffness = 1e5});
    std::vector<Index> end;
    for (Index i = 0; i < workload.mesh.vertex_count(); ++i) {
      if (workload.mesh.vertices(i, 0) == 0) end.push_back(i);
    }
    simulation.add(body, Position{.on = end, .hold = Hold::soft, .stiffness = 1e6});
  }
  return simulation;
}

double median(std::vector<double> seconds) {
  std::ranges::sort(seconds);
  return seconds[seconds.size() / 2];
}

#ifdef PLIANT_HAS_CHOLMOD
/// CHOLMOD's own analysis and factorization with its defaults [s].
double cholmod_seconds(const LowerMatrix& matrix) {
  cholmod_common common;
  cholmod_start(&common);
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(matrix.size());
  view.nzmax = matrix.rows.size();
  view.p = const_cast<Index*>(matrix.column_starts.data());
  view.i = const_cast<Index*>(matrix.rows.data());
  view.x = const_cast<Real*>(matrix.values.data());
  view.stype = -1;
  view.xtype = CHOLMOD_REAL;
  view.sorted = view.packed = 1;
  const Stopwatch watch;
  cholmod_factor* factor = cholmod_analyze(&view, &common);
  cholmod_factorize(&view, factor, &common);
  const double seconds = watch.seconds();
  cholmod_free_factor(&factor, &common);
  cholmod_finish(&common);
  return seconds;
}
#else
double cholmod_seconds(const LowerMatrix&) {
  return 0;
}
#endif

struct Timings {
  std::vector<double> eigen_solve, iteration, local, global;
};

/// Eigen's solve of the same matrix and steps of the simulation, in turns.
Timings time_in_turns(Simulation& simulation, const LowerMatrix& matrix, int repeats) {
  const Sparse lower = Eigen::Map<const Sparse>(matrix.size(), matrix.size(), static_cast<Index>(matrix.rows.size()),
                                                matrix.column_starts.data(), matrix.rows.data(), matrix.values.data());
  const Eigen::SimplicialLLT<Sparse> llt(lower);
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(matrix.size(), 3);
  Eigen::MatrixXd x = llt.solve(b);
  simulation.step();
  Timings timings;
  for (int i = 0; i < repeats; ++i) {
    const Stopwatch watch;
    x = llt.solve(b);
    timings.eigen_solve.push_back(watch.seconds());
    const StepReport report = simulation.step();
    timings.iteration.push_back(report.seconds_total / report.iterations);
    timings.local.push_back(report.seconds_local / report.iterations);
    timings.global.push_back(report.seconds_global / report.iterations);
  }
  return timings;
}

void run(const Workload& workload, Backend backend, std::string_view backend_name, int repeats) {
  const Stopwatch watch;
  Simulation simulation = simulate(workload, backend);
  const double build = watch.seconds();
  const double setup = build + simulation.step().seconds_factor;
  const LowerMatrix matrix = pliant_bench::system_matrix(simulation);
  const double own = median({cholmod_seconds(matrix), cholmod_seconds(matrix), cholmod_seconds(matrix)});
  const auto speed = static_cast<double>(std::max<Index>(1, matrix.size() / 1000));
  const Timings t = time_in_turns(simulation, matrix, std::max(5, static_cast<int>(repeats / speed)));
  const double eigen = median(t.eigen_solve);
  fmt::print("{:4} {:8} {:7} {:10.4f} {:10.4f} {:6.2f} {:9.4f} {:9.4f} {:9.1f} {:9.1f} {:6.2f}\n", workload.name,
             backend_name, matrix.size(), 1e3 * eigen, 1e3 * median(t.iteration), median(t.iteration) / eigen,
             1e3 * median(t.local), 1e3 * median(t.global), 1e3 * setup, 1e3 * own, own > 0 ? setup / own : 0.0);
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::max(1, std::atoi(argv[1])) : 200;
  fmt::print("{:4} {:8} {:7} {:>10} {:>10} {:>6} {:>9} {:>9} {:>9} {:>9} {:>6}\n", "", "backend", "m", "Eigen ms",
             "iter. ms", "ratio", "local", "global", "set-up", "CHOLMOD", "ratio");
  const std::vector<Workload> workloads = {curtain("W1", 32, 5, false),
                                           curtain("W1b", 32, 5, true),
                                           curtain("W2", 100, 10, false),
                                           curtain("W2b", 100, 10, true),
                                           curtain("W3", 316, 10, false),
                                           curtain("W3b", 316, 10, true),
                                           tetrahedra("W4")};
  for (const Workload& workload : workloads) {
    run(workload, Backend::eigen, "eigen", repeats);
#ifdef PLIANT_HAS_CHOLMOD
    run(workload, Backend::cholmod, "cholmod", repeats);
#endif
  }
  return 0;
}
