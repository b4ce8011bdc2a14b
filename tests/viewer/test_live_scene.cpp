// The simulation's own thread. Nothing here depends on how fast it is: what is waited for comes, or the test hangs and
// is ended from outside.
#include <thread>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant/mesh/shapes.h"
#include "viewer/live_scene.h"

namespace test_live_scene {

using namespace pliant_viewer;

namespace {

pliant::Scene make_scene(const std::string& set = "steps=1") {
  return pliant::parse_scene(R"({ "pliant": 1, "bodies": [ {
    "name": "sheet", "mesh": { "shape": "grid", "columns": 10, "rows": 10, "plane": "xz" }, "mass": { "total": 1 },
    "constraints": [ { "type": "position", "on": [90, 99] },
                     { "type": "edge_spring", "name": "springs", "stiffness": 500 } ] } ] })",
                             {}, "sheet", {.set = {set}});
}

void wait_until(const std::function<bool()>& is_so) {
  while (!is_so()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

const Snapshot& wait_for(LiveScene& live, std::uint64_t command) {
  wait_until([&] { return live.newest().commands >= command; });
  return live.shown();
}

}  // namespace

TEST_CASE("it plays, pauses, takes single steps, and shows the last of them") {
  LiveScene live([] { return make_scene(); }, 1, false, [] {});
  CHECK(live.newest().step == 0);
  CHECK_FALSE(live.shown().is_playing);
  const auto one_step = [](CommandContext& context) { context.single_steps = 1; };
  live.post(one_step);
  wait_until([&] { return live.newest().step == 1; });
  live.post(one_step);
  wait_until([&] { return live.newest().step == 2; });
  live.post([](CommandContext& context) { context.is_playing = true; });
  wait_until([&] { return live.newest().step > 10; });
  const Snapshot& paused = wait_for(live, live.post([](CommandContext& context) { context.is_playing = false; }));
  CHECK_FALSE(paused.is_playing);
  const std::int64_t step = paused.step;
  std::int64_t seen = -1;
  wait_for(live, live.post([&](CommandContext& context) { seen = context.session.simulation().state().step; }));
  CHECK(seen == step);  // what is shown is where it stands
  CHECK(live.shown().frame.content.positions.size() == 100);
}

TEST_CASE("commands act in their order, and what one throws is told") {
  LiveScene live([] { return make_scene(); }, 1, true, [] {});
  std::vector<int> order;
  for (int i = 0; i < 100; ++i) live.post([&order, i](CommandContext&) { order.push_back(i); });
  wait_for(live, 100);
  CHECK(order.size() == 100);
  CHECK(std::ranges::is_sorted(order));
  const Snapshot& shown = wait_for(live, live.post([](CommandContext& context) {
    context.session.set("settings.time_step", {-1, 0, 0});
  }));
  CHECK(shown.note.find("time_step") != std::string::npos);
  CHECK(shown.is_playing);
}

TEST_CASE("a step that would last for hours is given up for a change, and for the end") {
  LiveScene live([] { return make_scene("settings.iterations=1000000000"); }, 1, true, [] {});
  live.post([](CommandContext& context) { context.session.set("settings.iterations", {5, 0, 0}); });
  wait_until([&] { return live.newest().step > 3; });
  live.post([](CommandContext& context) { context.session.set("settings.iterations", {1e9, 0, 0}); });
  wait_for(live, 2);
  live.post([](CommandContext& context) { context.restart(false); }, LiveScene::Kind::ends);
  wait_until([&] { return live.newest().restarts == 1; });
  CHECK(live.shown().step == 0);
}  // the destructor does not wait for a thousand million iterations

TEST_CASE("a simulation that diverges pauses and says so; starting over helps") {
  LiveScene live(
      [] {
        return make_scene(
            "forces=[{\"type\":\"mouse_spring\",\"body\":\"sheet\",\"vertex\":5,"
            "\"anchor\":[0,0,5],\"stiffness\":1e9}]");
      },
      1, true, [] {});
  live.post([](CommandContext& context) { context.pacer.set_speed(Pacer::unlimited); });
  wait_until([&] { return !live.newest().is_playing; });
  CHECK_FALSE(live.shown().note.empty());
  bool is_finite = false;
  wait_for(live, live.post([&](CommandContext& context) {
    is_finite = context.session.simulation().state().positions.allFinite();
  }));
  CHECK(is_finite);
  live.post([](CommandContext& context) { context.restart(false); }, LiveScene::Kind::ends);
  wait_until([&] { return live.newest().restarts == 1; });
  CHECK(live.shown().step == 0);
  CHECK(live.shown().note.empty());
}

TEST_CASE("a mesh that is another one after a restart is shown as what it is") {
  int columns = 4;
  LiveScene live(
      [&] {
        pliant::Scene scene;
        scene.simulation.add_body(pliant::grid({.columns = columns, .rows = 3}), pliant::Mass::total(1));
        return scene;
      },
      1, false, [] {});
  const auto restart = [&] { wait_for(live, live.post([](CommandContext& context) { context.restart(true); })); };
  const auto first = live.newest().render_mesh;
  restart();
  CHECK(live.shown().render_mesh == first);
  columns = 6;
  restart();
  CHECK(live.shown().render_mesh != first);
  CHECK(live.shown().render_mesh->vertex_count == 18);
  CHECK(live.shown().frame.content.positions.size() == 18);
}

}  // namespace test_live_scene
