// How much of a simulation's speed a window takes, how often it is drawn, and how long it takes to answer the mouse.
// A curtain with bending, simulated by one thread as fast as it can, in turns without a window and with one of
// 1280 × 720; medians.
//
//     bench_window [columns [iterations [repeats [seconds]]]]      needs a display: under xvfb-run where there is none
#include <algorithm>
#include <cstdlib>
#include <string>
#include <thread>

#include <fmt/format.h>

#include "pliant/pliant.h"
#include "viewer/live_source.h"
#include "viewer/viewer.h"

namespace {

using namespace pliant;
using pliant_viewer::Clock;
using pliant_viewer::Seconds;

Scene make_scene(Index columns, Index iterations) {
  Scene scene;
  scene.name = "curtain";
  scene.simulation.set_settings({.iterations = iterations, .threads = 1});
  const BodyId curtain =
      scene.simulation.add_body(grid({.columns = columns, .rows = columns}), Mass::area_density(0.3));
  scene.simulation.add(curtain, EdgeSpring{.stiffness = 1e3}, "springs");
  scene.simulation.add(curtain, Bending{.stiffness = 1e-3}, "bending");
  scene.simulation.add(curtain, Position{.on = {columns * (columns - 1), columns * columns - 1}}, "pins");
  scene.simulation.add(Gravity{});
  scene.simulation.add(curtain, Wind{.velocity = {0, 1, 0}}, "wind");
  return scene;
}

double median(std::vector<double> numbers) {
  std::ranges::sort(numbers);
  return numbers[numbers.size() / 2];
}

struct Count {
  std::int64_t steps;
  Clock::time_point when;
};

/// The steps so far, as the simulation's own thread says.
Count count_steps(pliant_viewer::LiveScene& live) {
  std::atomic<bool> is_done = false;
  Count count{};
  live.post([&](pliant_viewer::CommandContext& context) {
    count = {context.session.simulation().state().step, Clock::now()};
    is_done = true;
    is_done.notify_one();
  });
  is_done.wait(false);
  return count;
}

double rate(const Count& from, const Count& to) {
  return static_cast<double>(to.steps - from.steps) / Seconds(to.when - from.when).count();
}

void run_unlimited(pliant_viewer::LiveScene& live) {
  live.post([](pliant_viewer::CommandContext& context) { context.pacer.set_speed(pliant_viewer::Pacer::unlimited); });
}

double steps_without_window(const pliant_viewer::MakeScene& make, double seconds) {
  pliant_viewer::LiveScene live(make, 1, true, [] {});
  run_unlimited(live);
  std::this_thread::sleep_for(Seconds(0.5));
  const Count begin = count_steps(live);
  std::this_thread::sleep_for(Seconds(seconds));
  return rate(begin, count_steps(live));
}

struct WithWindow {
  double steps;
  double pictures;
  double longest_turn;  // [s]
};

WithWindow with_window(pliant_viewer::Window& window, const pliant_viewer::MakeScene& make, double seconds) {
  pliant_viewer::LiveSource source(make, 1, true, pliant_viewer::Window::wake);
  run_unlimited(*source.live());
  pliant_viewer::ViewerOptions options;
  options.appearance = source.appearance();
  pliant_viewer::Viewer viewer(window, source, std::move(options));
  const auto turn_for = [&](double time) {
    double longest = 0;
    const Clock::time_point begin = Clock::now();
    while (Seconds(Clock::now() - begin).count() < time) {
      const Clock::time_point before = Clock::now();
      viewer.turn(0.05);
      longest = std::max(longest, Seconds(Clock::now() - before).count());
    }
    return longest;
  };
  turn_for(1);
  const std::uint64_t pictures = viewer.frame_count();
  const Count begin = count_steps(*source.live());
  WithWindow result{};
  result.longest_turn = turn_for(seconds);
  const Count end = count_steps(*source.live());
  result.steps = rate(begin, end);
  result.pictures = static_cast<double>(viewer.frame_count() - pictures) / Seconds(end.when - begin.when).count();
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  const auto number = [&](int i, double otherwise) { return argc > i ? std::atof(argv[i]) : otherwise; };
  const auto columns = static_cast<Index>(number(1, 100));
  const auto iterations = static_cast<Index>(number(2, 5));
  const int repeats = static_cast<int>(number(3, 5));
  const double seconds = number(4, 4);
  const pliant_viewer::MakeScene make = [&] { return make_scene(columns, iterations); };
  setenv("LP_NUM_THREADS", "1", 0);
  try {
    pliant_viewer::Window window("Pliant", 1280, 720);
    std::vector<double> without, with, pictures, turns, shares;
    for (int i = 0; i < repeats; ++i) {
      without.push_back(steps_without_window(make, seconds));
      const WithWindow measured = with_window(window, make, seconds);
      with.push_back(measured.steps);
      pictures.push_back(measured.pictures);
      turns.push_back(measured.longest_turn);
      shares.push_back(with.back() / without.back());
    }
    fmt::print("{} vertices, {} iterations, drawn by {}\n", columns * columns, iterations, window.driver());
    fmt::print("steps a second: {:.1f} without a window, {:.1f} with one; share {:.3f}\n", median(without),
               median(with), median(shares));
    fmt::print("pictures a second: {:.1f}; the longest turn {:.0f} ms\n", median(pictures), 1e3 * median(turns));
    return 0;
  } catch (const Error& error) {
    fmt::print(stderr, "bench_window: {}\n", error.what());
    return static_cast<int>(error.kind());
  }
}
