// The window as a program opens it: pliant::view, and types of the program's own in its panel.
#define DOCTEST_CONFIG_IMPLEMENT
#include <atomic>
#include <thread>

#include <doctest/doctest.h>

#include "../simulation/own_types.h"
#include "desk.h"
#include "pliant_viewer/pliant_viewer.h"

using namespace pliant_tests;
using pliant::BodyId;
using pliant::GroupId;
using pliant::Simulation;

namespace {

/// A sheet hung by two corners, outside of a ball, in a whirl, above an egg: the last three of the program's own types.
Scene make_own() {
  Scene scene = make_sheet();
  scene.simulation.add(BodyId{0}, OutsideBall{.center = {0.5, 0.1, 0.5}, .radius = 0.2}, "ball");
  scene.simulation.add(Whirl{}, "whirl");
  scene.simulation.add(EggCollider{.center = {0, 0, -3}}, "egg");
  return scene;
}

struct OwnDesk : Desk {
  OwnDesk() : Desk(make_own) {}
  /// Types a number into a row of the panel.
  void type(const std::string& key, const std::string& text) {
    turn_until([&] { return source.parameter_panel().place_of(key).has_value(); });
    for (int i = 0; i < 40 && source.parameter_panel().place_of(key).value()[3] > window.size().y(); ++i) scroll();
    type_into(key);
    xdotool("key ctrl+a");
    xdotool("type " + text);
    this->key("Return");
  }
  void scroll() {
    move({window.size().x() - 100, 400});
    xdotool("click 5");
    turns(3);
  }
};

void focus_window() {
  xdotool("search --sync --onlyvisible --name 'sheet|simulation' windowfocus");
}

/// Keys for a window that another thread shows.
class Hand {
 public:
  explicit Hand(std::function<void()> what)
      : thread_([what = std::move(what)] {
          focus_window();
          what();
        }) {}
  ~Hand() { thread_.join(); }

 private:
  std::thread thread_;
};

void wait_until(const std::function<bool()>& is_so) {
  while (!is_so()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

/// Presses a key of an open window, again where it was lost: the focus may have gone to the window of the case before,
/// which was about to close.
void press_until(const std::string& key, const std::function<bool()>& is_so) {
  while (!is_so()) {
    focus_window();
    xdotool("key " + key);
    for (int i = 0; i < 600 && !is_so(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

Simulation make_simulation() {
  return std::move(make_own().simulation);
}

}  // namespace

TEST_CASE("options of a program's own types are rows of the panel: set, taken back, kept by a restart") {
  OwnDesk desk;
  CHECK(desk.parameter("force:whirl.strength") == 2);
  CHECK(desk.parameter("group:ball.radius") == 0.2);
  desk.type("force:whirl.strength", "7.5");
  desk.turn_until([&] { return desk.parameter("force:whirl.strength") == 7.5; });
  CHECK(desk.shown().undone_next == "whirl: strength");
  desk.key("r");
  desk.turn_until([&] { return desk.shown().restarts == 1; });
  CHECK(desk.parameter("force:whirl.strength") == 7.5);
  desk.key("ctrl+z");
  desk.turn_until([&] { return desk.parameter("force:whirl.strength") == 2; });
  desk.key("ctrl+shift+z");
  desk.turn_until([&] { return desk.parameter("force:whirl.strength") == 7.5; });
}

TEST_CASE("a program's simulation is shown, goes on, and is given back where the window has left it") {
  Simulation simulation = make_simulation();
  const GroupId hooks = simulation.find_group("hooks").value();
  std::atomic<int> steps = 0, restarts = 0;
  std::atomic<bool> is_on_time = true;
  double time_before = -1;
  pliant::ViewOptions options;
  options.before_step = [&](Simulation& now) {
    is_on_time = is_on_time && now.state().time > time_before;
    time_before = now.state().time;
    now.set_target(hooks, 0, {0, 0.001 * ++steps, 1});
  };
  options.restarted = [&](Simulation& now) {
    CHECK(now.state().step == 0);
    CHECK(now.target(hooks, 0) == pliant::Vec3(0, 0, 1));
    time_before = -1;
    steps = 0;
    ++restarts;
  };
  {
    const Hand hand([&] {
      wait_until([&] { return steps > 30; });
      press_until("r", [&] { return restarts > 0; });
      wait_until([&] { return restarts == 1 && steps > 20; });
      xdotool("key ctrl+q");
    });
    pliant::view(simulation, options);
  }
  CHECK(is_on_time);
  CHECK(simulation.state().step > 20);
  CHECK(simulation.settings().threads == 1);
  CHECK(simulation.target(hooks, 0).y() == doctest::Approx(0.001 * steps));
  CHECK_FALSE(simulation.find_group("mouse").has_value());
  const auto step = simulation.state().step;
  simulation.step();  // nothing stops it
  CHECK(simulation.state().step == step + 1);
}

TEST_CASE("a window closes when its program says so, and another one opens after it") {
  Simulation simulation = make_simulation();
  simulation.set_settings({.iterations = 10});
  for (int i = 0; i < 2; ++i) {
    std::atomic<bool> is_over = false;
    const double end = simulation.state().time + 0.5;
    pliant::ViewOptions options;
    options.before_step = [&](Simulation& now) { is_over = is_over || now.state().time >= end; };
    options.should_close = [&] { return is_over.load(); };
    pliant::view(simulation, options);
    CHECK(simulation.state().time >= end);
  }
  CHECK(simulation.settings().threads == 0);  // whatever the window had
}

TEST_CASE("what a program throws before a step pauses, and is told in the window") {
  Simulation simulation = make_simulation();
  std::atomic<int> calls = 0;
  std::atomic<bool> is_over = false;
  pliant::ViewOptions options;
  options.before_step = [&](Simulation& now) {
    ++calls;
    if (now.state().step == 5) throw std::runtime_error("the motor is out of oil");
  };
  options.should_close = [&] { return is_over.load(); };
  {
    const Hand hand([&] {
      wait_until([&] { return calls == 6; });
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      CHECK(calls == 6);
      press_until("space", [&] { return calls == 7; });
      is_over = true;
    });
    pliant::view(simulation, options);
  }
  CHECK(simulation.state().step == 5);
}

TEST_CASE("paused, nothing goes on before a key") {
  Simulation simulation = make_simulation();
  std::atomic<int> steps = 0;
  pliant::ViewOptions options;
  options.paused = true;
  options.before_step = [&](Simulation&) { ++steps; };
  {
    const Hand hand([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      CHECK(steps == 0);
      press_until("s", [&] { return steps == 1; });
      xdotool("key ctrl+q");
    });
    pliant::view(simulation, options);
  }
  CHECK(simulation.state().step == 1);
}

TEST_CASE("a scene that was read is shown with its name, saved from the window, and given back with its text") {
  const TemporaryFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  Scene scene = pliant::parse_scene(R"({ "pliant": 1, "name": "sheet of paper", "bodies": [ { "name": "sheet",
    "mass": { "total": 1 }, "mesh": { "shape": "grid", "columns": 9, "rows": 9, "plane": "xz" },
    "constraints": [ { "type": "position", "on": [72, 80] }, { "type": "edge_spring", "stiffness": 500 } ] } ] })",
                                    {}, "sheet");
  std::atomic<bool> is_over = false;
  pliant::ViewOptions options;
  options.should_close = [&] { return is_over.load(); };
  {
    const Hand hand([&] {
      xdotool("search --sync --onlyvisible --name 'sheet of paper - Pliant' windowfocus");
      wait_until([&] {
        xdotool("key ctrl+s");
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        return folder.file_count() > 0;
      });
      is_over = true;
    });
    pliant::view(scene, options);
  }
  std::filesystem::current_path(before);
  CHECK(scene.simulation.state().step > 0);
  CHECK(scene.name == "sheet of paper");
  CHECK(scene.source.texts.size() == 1);
  CHECK(pliant::load_scene(folder.path() / "sheet of paper-1.json").simulation.bodies().size() == 1);
}

int main(int argc, char** argv) {
  return run_on_display(argc, argv);
}
