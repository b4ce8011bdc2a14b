// When and where moves put their targets.
#include <string>

#include <doctest/doctest.h>

#include "pliant_io/scene/scene.h"

namespace test_timeline {

namespace {

using namespace pliant;

/// Three hard pins at (0, 0, 0), (1, 0, 0), (2, 0, 0), steps of 0.1 s.
Scene scene_with_moves(const std::string& moves) {
  return parse_scene(R"({"pliant": 1, "gravity": null, "settings": {"time_step": 0.1}, "bodies": [{
    "mesh": {"vertices": [[0, 0, 0], [1, 0, 0], [2, 0, 0]]}, "mass": {"per_vertex": 1},
    "constraints": [{"type": "position", "name": "pins"}]}], "moves": [)" +
                         moves + "]}",
                     {}, "s.json");
}

/// z of a vertex after each of a number of steps.
std::vector<Real> heights(const std::string& moves, Index vertex, int steps) {
  Scene scene = scene_with_moves(moves);
  std::vector<Real> z;
  for (int i = 0; i < steps; ++i) {
    scene.step();
    z.push_back(scene.simulation.state().positions(vertex, 2));
  }
  return z;
}

void check_close(const std::vector<Real>& found, const std::vector<Real>& expected) {
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    CAPTURE(i);
    CHECK(std::abs(found[i] - expected[i]) < 1e-14);
  }
}

TEST_CASE("a move at step n acts before the step n → n + 1") {
  CHECK(heights(R"({"group": "pins", "step": 0, "index": 1, "target": [1, 0, 5]})", 1, 2) == std::vector<Real>{5, 5});
  CHECK(heights(R"({"group": "pins", "step": 2, "index": 1, "target": [1, 0, 5]})", 1, 4) ==
        std::vector<Real>{0, 0, 5, 5});
  CHECK(heights(R"({"group": "pins", "step": 2, "index": 1, "target": [1, 0, 5]})", 0, 4) ==
        std::vector<Real>{0, 0, 0, 0});
}

TEST_CASE("a time maps to the first step that does not begin before it") {
  const auto at = [](const std::string& time) {
    return heights(R"({"group": "pins", "target": [0, 0, 5], "time": )" + time + "}", 0, 5);
  };
  CHECK(at("0.3") == std::vector<Real>{0, 0, 0, 5, 5});  // 0.3/0.1 is a rounding above 3
  CHECK(at("0.21") == std::vector<Real>{0, 0, 0, 5, 5});
  CHECK(at("0.2") == std::vector<Real>{0, 0, 5, 5, 5});
  CHECK(at("0") == std::vector<Real>{5, 5, 5, 5, 5});
}

TEST_CASE("offsets count from where the target is, points may be one each") {
  const std::string up = R"({"group": "pins", "step": 1, "offset": [0, 0, 1]})";
  CHECK(heights(up + "," + R"({"group": "pins", "step": 2, "offset": [0, 0, 2]})", 2, 3) == std::vector<Real>{0, 1, 3});
  CHECK(heights(R"({"group": "pins", "step": 1, "offset": [[0, 0, 1], [0, 0, 2], [0, 0, 3]]})", 2, 2) ==
        std::vector<Real>{0, 3});
}

TEST_CASE("a move over a time goes straight at constant speed and ends exactly") {
  const std::string move = R"({"group": "pins", "step": 1, "over": 0.4, "target": [0.1, 0.2, 1]})";
  check_close(heights(move, 0, 7), {0, 0.25, 0.5, 0.75, 1, 1, 1});
  CHECK(heights(move, 0, 5).back() == 1);
  check_close(heights(R"({"group": "pins", "step": 0, "over": 0.25, "target": [0, 0, 1]})", 0, 4), {0.4, 0.8, 1, 1});
}

TEST_CASE("a later move takes over from where an earlier one has come") {
  const std::string slow = R"({"group": "pins", "step": 0, "over": 1, "target": [0, 0, 1]})";
  check_close(heights(slow + "," + R"({"group": "pins", "step": 2, "over": 0.2, "offset": [0, 0, -0.2]})", 0, 5),
              {0.1, 0.2, 0.1, 0, 0});
  // Whatever the order in the file.
  check_close(heights(R"({"group": "pins", "step": 2, "index": 0, "target": [0, 0, 9]},)" + slow, 0, 4),
              {0.1, 0.2, 9, 9});
}

}  // namespace

}  // namespace test_timeline
