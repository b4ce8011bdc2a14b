// What measuring a step costs beside the step itself, as the window does for its plots: all columns of
// measurements.csv, all but the stretch past limits, or those that take no local step. To be run from the source
// folder.
//
//     bench_measuring [steps]
#include <algorithm>
#include <cstdlib>
#include <vector>

#include <fmt/format.h>

#include "pliant/core/stopwatch.h"
#include "pliant_io/recorder/measurements.h"
#include "pliant_io/scene/scene.h"

namespace {

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

void measure_scene(const char* name, const std::vector<std::string>& set, int steps) {
  pliant::Scene scene = pliant::load_scene(fmt::format("scenes/{}.json", name), {.set = set});
  scene.simulation.set_settings([&] {
    pliant::SolverSettings settings = scene.simulation.settings();
    settings.threads = 1;
    return settings;
  }());
  std::vector<double> step, all, energies, motion;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const pliant::StepReport report = scene.step();
    step.push_back(1e3 * report.seconds_total);
    pliant::Stopwatch watch;
    sum += measure(scene.simulation, report).total;
    all.push_back(1e3 * watch.seconds());
    watch = {};
    sum += measure_energies(scene.simulation, report).total;
    energies.push_back(1e3 * watch.seconds());
    watch = {};
    sum += measure_motion(scene.simulation, report).kinetic;
    motion.push_back(1e3 * watch.seconds());
  }
  fmt::print("{:14} {:8} {:8.2f}", name, scene.simulation.state().vertex_count(), median(step));
  for (const std::vector<double>& each : {all, energies, motion}) {
    fmt::print(" {:8.3f} {:5.2f} %", median(each), 100 * median(each) / median(step));
  }
  fmt::print("   ({:.3g})\n", sum);
}

}  // namespace

int main(int argc, char** argv) {
  const int steps = argc > 1 ? std::max(1, std::atoi(argv[1])) : 60;
  fmt::print("{:14} {:>8} {:>8} {:>16} {:>16} {:>16}\n", "scene", "vertices", "step ms", "all ms", "energies ms",
             "motion ms");
  const std::vector<std::string> fine = {"bodies[0].mesh.columns=100", "bodies[0].mesh.rows=100"};
  measure_scene("curtain", fine, steps);
  measure_scene("curtain_wind", fine, steps);
  measure_scene("towel", fine, steps);
}
