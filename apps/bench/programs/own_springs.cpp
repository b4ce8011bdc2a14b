// Springs of a type of one's own, as examples/own_constraint.cpp adds one, beside those of the library: what a
// projection in NumPy (python/benchmarks/own_springs.py) is compared with. 100 × 100 vertices, 29,601 springs, ten
// iterations a step, one thread; processor times.
//
//     bench_own_springs [steps]
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <vector>

#include <fmt/format.h>

#include "pliant/pliant.h"

namespace {

struct OwnSpring {
  static constexpr std::string_view name = "own_spring";
  static constexpr int vertices = 2;
  static constexpr int rows = 1;
  static constexpr int fields = 1;  // length
  static constexpr bool translation_invariant = true;
  static void project(const double* length, const double* z, double* p) {
    const double scale = *length / std::sqrt(z[0] * z[0] + z[1] * z[1] + z[2] * z[2]);
    for (int axis = 0; axis < 3; ++axis) p[axis] = scale * z[axis];
  }
};

pliant::ConstraintSet own_springs(const pliant::Mesh& mesh, double stiffness) {
  auto batch = std::make_unique<pliant::Batch<OwnSpring>>(stiffness);
  const std::array<double, 2> difference = {-1, 1};
  pliant::ConstraintSet set;
  for (const pliant::Edge& edge : pliant::unique_edges(mesh)) {
    const double length = (mesh.vertices.row(edge[1]) - mesh.vertices.row(edge[0])).norm();
    batch->add(edge, difference, 1, {&length, 1});
    ++set.count;
  }
  set.batches.push_back(std::move(batch));
  return set;
}

pliant::Simulation made(bool is_own) {
  pliant::Simulation simulation({.threads = 1});
  const pliant::Mesh mesh = pliant::grid({.columns = 100, .rows = 100});
  const pliant::BodyId cloth = simulation.add_body(mesh, pliant::Mass::area_density(0.2));
  if (is_own) {
    simulation.add_set(cloth, own_springs(mesh, 1e3), "own_spring");
  } else {
    simulation.add(cloth, pliant::EdgeSpring{.stiffness = 1e3});
  }
  simulation.add(cloth, pliant::Position{.on = {9900, 9999}});
  simulation.add(pliant::Gravity{});
  for (int i = 0; i < 20; ++i) simulation.step();
  return simulation;
}

double processor_milliseconds() {
  return 1e3 * static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

}  // namespace

int main(int argc, char** argv) {
  const int steps = argc > 1 ? std::max(1, std::atoi(argv[1])) : 60;
  std::array<pliant::Simulation, 2> simulations = {made(false), made(true)};
  std::array<std::vector<double>, 2> times;
  for (int i = 0; i < steps; ++i) {  // in turns, so that both meet the same disturbances
    for (std::size_t which = 0; which < 2; ++which) {
      const double begin = processor_milliseconds();
      simulations[which].step();
      times[which].push_back(processor_milliseconds() - begin);
    }
  }
  for (std::vector<double>& each : times) std::ranges::sort(each);
  const std::size_t middle = times[0].size() / 2;
  fmt::print("springs of the library {:.2f} ms a step, of one's own in C++ {:.2f} ms, {:.2f} times as long\n",
             times[0][middle], times[1][middle], times[1][middle] / times[0][middle]);
}
