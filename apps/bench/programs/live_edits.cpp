// What an edit costs while a curtain of 100 × 100 vertices runs: the call, what the step after it takes to lay out
// anew, and for that and the sum and factor of the matrix, and for comparison a step without. Minima over repeats, one
// thread. Then what a ramp of a stiffness costs: the mean of its steps by the median of plain ones.
//
//     bench_live_edits [repeats]
#include <algorithm>
#include <functional>
#include <string>

#include <fmt/format.h>

#include "pliant/core/stopwatch.h"
#include "pliant/pliant.h"
#include "pliant/timeline/timeline.h"

namespace {

using namespace pliant;

constexpr BodyId curtain{0};

Simulation make() {
  Simulation simulation({.iterations = 10, .threads = 1});
  simulation.add_body(grid({.columns = 100, .rows = 100}), Mass::area_density(0.3));
  simulation.add(curtain, EdgeSpring{.stiffness = 1e3}, "springs");
  simulation.add(curtain, HingeBending{.stiffness = 1e-3}, "hinges");
  simulation.add(curtain, Position{.on = {9900, 9999}}, "pins");
  simulation.add(curtain, TriangleStrain{.stiffness = 10}, "skin");
  simulation.add(Gravity{});
  simulation.add(curtain, Wind{.velocity = {0, 1, 0}}, "wind");
  return simulation;
}

double best(const std::vector<double>& seconds) {
  return *std::ranges::min_element(seconds);
}

struct Edit {
  std::string name;
  std::function<void(Simulation&, int repeat)> act;
  std::function<void(Simulation&)> back = [](Simulation&) {};  // not measured
};

GroupId id(const Simulation& simulation, std::string_view name) {
  return simulation.find_group(name).value();
}

void measure(const Edit& edit, int repeats) {
  Simulation simulation = make();
  for (int i = 0; i < 5; ++i) simulation.step();
  std::vector<double> call;
  std::vector<double> layout;
  std::vector<double> factor;
  std::vector<double> step;
  for (int i = 0; i < repeats; ++i) {
    edit.back(simulation);
    simulation.step();
    const Stopwatch editing;
    edit.act(simulation, i + 1);
    call.push_back(editing.seconds());
    const StepReport report = simulation.step();
    layout.push_back(report.set_up.layout);
    factor.push_back(report.seconds_factor);
    step.push_back(simulation.step().seconds_total);
  }
  fmt::print("{:44} {:8.2f} {:9.2f} {:9.2f} {:8.2f}\n", edit.name, 1e3 * best(call), 1e3 * best(layout),
             1e3 * best(factor), 1e3 * best(step));
}

std::vector<Edit> edits_of_drags() {
  const auto add_drag = [](Simulation& s, int) {
    const Vec3 target = row(s.state().positions, 5050) + Vec3(0, 0.1, 0);
    s.add(curtain, Drag{.stencils = {{5050, 5051, 5151}}, .targets = target}, "drag");
  };
  const auto remove_drag = [](Simulation& s) {
    if (const auto drag = s.find_group("drag")) s.remove(*drag);
  };
  return {{"drag added", add_drag, remove_drag},
          {"drag let go", [=](Simulation& s, int) { remove_drag(s); }, [=](Simulation& s) { add_drag(s, 0); }},
          {"stiffness of a drag", [=](Simulation& s, int i) {
             if (!s.find_group("drag")) add_drag(s, 0);
             s.set_stiffness(id(s, "drag"), 1000 + i);
           }}};
}

/// Of pins that come while it runs; the step after is one with them.
std::vector<Edit> edits_of_pins() {
  const auto add_pins = [](Index count, Hold hold) {
    return [=](Simulation& s, int) {
      std::vector<Index> vertices;
      for (Index i = 0; i < count; ++i) vertices.push_back(50 + 156 * i + 37 * i % 50);
      s.add(curtain, Position{.on = vertices, .hold = hold}, "late");
    };
  };
  const auto remove_pins = [](Simulation& s) {
    if (const auto pins = s.find_group("late")) s.remove(*pins);
  };
  std::vector<Edit> list;
  for (const Index count : {1, 8, 32}) {
    list.push_back({fmt::format("{} pins added", count), add_pins(count, Hold::hard), remove_pins});
    list.push_back({fmt::format("{} soft pins added", count), add_pins(count, Hold::soft), remove_pins});
  }
  list.push_back({"32 pins let go", [=](Simulation& s, int) { remove_pins(s); },
                  [=](Simulation& s) { add_pins(32, Hold::hard)(s, 0); }});
  return list;
}

std::vector<Edit> edits() {
  const auto map = [](const Simulation& s, int repeat) {
    const auto count = static_cast<std::size_t>(s.groups().at(id(s, "springs")).set.count);
    return std::vector<Real>(count, 1000 + repeat);
  };
  const auto settings = [](Simulation& s, auto&& change) {
    SolverSettings changed = s.settings();
    change(changed);
    s.set_settings(changed);
  };
  return {
      {"nothing", [](Simulation&, int) {}},
      {"stiffness of a group", [](Simulation& s, int i) { s.set_stiffness(id(s, "springs"), 1000 + i); }},
      {"stiffness map of a group",
       [=](Simulation& s, int i) { s.replace(id(s, "springs"), EdgeSpring{.stiffness = map(s, i)}); }},
      {"time step",
       [=](Simulation& s, int i) { settings(s, [i](SolverSettings& x) { x.time_step = 1.0 / (60 + i % 2); }); }},
      {"iterations", [=](Simulation& s, int i) { settings(s, [i](SolverSettings& x) { x.iterations = 10 + i % 2; }); }},
      {"pin released", [](Simulation& s, int) { s.release(id(s, "pins"), std::array<Index, 1>{9900}); },
       [](Simulation& s) {
         s.replace(id(s, "pins"), Position{.on = {9900, 9999}});
       }},
      {"pin moved",
       [](Simulation& s, int i) {
         s.set_target(id(s, "pins"), 0, {0, 1e-4 * i, 1});
       }},
      {"group removed, edges stay connected by others", [](Simulation& s, int) { s.remove(id(s, "skin")); },
       [](Simulation& s) {
         if (!s.find_group("skin")) s.add(curtain, TriangleStrain{.stiffness = 10}, "skin");
       }},
      {"group removed that alone connects vertices", [](Simulation& s, int) { s.remove(id(s, "hinges")); },
       [](Simulation& s) {
         if (!s.find_group("hinges")) s.add(curtain, HingeBending{.stiffness = 1e-3}, "hinges");
       }},
      {"group added that connects others",
       [](Simulation& s, int) { s.add(curtain, HingeBending{.stiffness = 1e-3}, "hinges"); },
       [](Simulation& s) {
         if (const auto hinges = s.find_group("hinges")) s.remove(*hinges);
       }},
      {"wind changed",
       [](Simulation& s, int i) {
         s.replace(*s.find_force("wind"), Wind{.velocity = {0, 1 + 1e-3 * i, 0}});
       }},
      {"gravity changed",
       [](Simulation& s, int i) { s.replace(*s.find_force("gravity"), Gravity{Vec3(0, 1e-3 * i, -9.81)}); }}};
}

/// A ramp over a second, to ten times the stiffness and back.
void measure_ramps(int repeats) {
  constexpr int steps = 60;
  for (const Real to : {1e4, 1e3}) {
    std::vector<double> ratios;
    int factorizations = 0;
    for (int i = 0; i < std::max(1, repeats / 5); ++i) {
      Simulation simulation = make();
      Timeline timeline;
      simulation.set_stiffness(id(simulation, "springs"), to == 1e4 ? 1e3 : 1e4);
      for (int step = 0; step < 5; ++step) timeline.step(simulation);
      std::vector<double> plain;
      for (int step = 0; step < 21; ++step) plain.push_back(timeline.step(simulation).seconds_total);
      std::ranges::nth_element(plain, plain.begin() + 10);
      timeline.ramp_stiffness(simulation, id(simulation, "springs"), to, 1);
      double seconds = 0;
      factorizations = 0;
      for (int step = 0; step < steps; ++step) {
        const StepReport report = timeline.step(simulation);
        seconds += report.seconds_total;
        factorizations += report.set_up.numeric > 0 ? 1 : 0;
      }
      ratios.push_back(seconds / steps / plain[10]);
    }
    fmt::print("ramp to {:.0e} N/m in {} steps: {} factorizations, {:.2f} times a plain step\n", to, steps,
               factorizations, best(ratios));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::max(1, std::atoi(argv[1])) : 11;
  fmt::print("{:44} {:>8} {:>9} {:>9} {:>8}\n", "edit", "call ms", "layout ms", "factor ms", "step ms");
  for (const Edit& edit : edits()) measure(edit, repeats);
  for (const Edit& edit : edits_of_pins()) measure(edit, repeats);
  for (const Edit& edit : edits_of_drags()) measure(edit, repeats);
  measure_ramps(repeats);
}
