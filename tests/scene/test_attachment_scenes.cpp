// Attachments in scene files: what ties bodies together, in contact, with events, and when a run is taken up again.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/simulation/parameters.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/scene/scene.h"
#include "tests/support/temporary_folder.h"

namespace test_attachment_scenes {

namespace {

using namespace pliant;

/// Two square panels that are drawn together all around in 0.3 s and touch each other.
std::string pouch(std::string_view attachment = "", std::string_view more = "") {
  constexpr std::string_view usual =
      R"({"name": "seam", "from": {"body": "front", "on": "boundary"}, "to": {"body": "back", "on": "boundary"},
          "mode": "seam", "closing_time": 0.3})";
  return fmt::format(
      R"({{"pliant": 1, "gravity": [0, 0, -1], "settings": {{"iterations": 15, "threads": 1}}, "bodies": [
  {{"name": "front", "mesh": {{"shape": "grid", "columns": 9, "rows": 9, "size": [0.2, 0.2], "plane": "xy"}},
   "transform": {{"translate": [0, 0, 0.03]}}, "mass": {{"area_density": 0.2}},
   "constraints": [{{"type": "triangle_strain", "stiffness": 300}}, {{"type": "bending", "stiffness": 1e-4}}]}},
  {{"name": "back", "mesh": {{"shape": "grid", "columns": 9, "rows": 9, "size": [0.2, 0.2], "plane": "xy"}},
   "mass": {{"area_density": 0.2}},
   "constraints": [{{"type": "triangle_strain", "stiffness": 300}}, {{"type": "bending", "stiffness": 1e-4}}]}}],
  "attachments": [{}], "contact": {{}}{}}})",
      attachment.empty() ? usual : attachment, more);
}

Scene scene_of(const std::string& text) {
  return parse_scene(text, {}, "s.json");
}

std::string message_of(const std::string& text) {
  try {
    scene_of(text);
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::input);
    return error.what();
  }
  return "(no error)";
}

void advance(Scene& scene, int steps) {
  for (int i = 0; i < steps; ++i) scene.step();
}

/// How far the border's vertices are from their partners, at most [m].
Real widest_gap(const Scene& scene) {
  const Positions& q = scene.simulation.state().positions;
  Real widest = 0;
  for (Index v = 0; v < 81; ++v) {
    if (v % 9 != 0 && v % 9 != 8 && v / 9 != 0 && v / 9 != 8) continue;
    widest = std::max(widest, (row(q, v) - row(q, 81 + v)).norm());
  }
  return widest;
}

}  // namespace

TEST_CASE("contact does not hold a seam open, and keeps the rest of the panels apart") {
  Scene scene = scene_of(pouch());
  CHECK(widest_gap(scene) == doctest::Approx(0.03));
  advance(scene, 9);
  CHECK(widest_gap(scene) == doctest::Approx(0.015).epsilon(0.1));
  advance(scene, 21);
  CHECK(scene.simulation.contact_distance(BodyId{0}) == doctest::Approx(0.00625));
  CHECK(widest_gap(scene) < 1e-4);
  const Positions& q = scene.simulation.state().positions;
  CHECK(row(q, 40)[2] - row(q, 81 + 40)[2] > 0.004);  // in the middle
}

TEST_CASE("a seam that is removed lets contact hold the panels apart again") {
  Scene scene = scene_of(pouch("", R"(, "events": [{"step": 30, "remove": "seam"}])"));
  advance(scene, 30);
  CHECK(widest_gap(scene) < 1e-4);
  advance(scene, 90);
  CHECK(widest_gap(scene) > 1e-3);
  CHECK(scene.simulation.groups().size() == 4);
}

TEST_CASE("threads change no bit of a run with seams, nor does taking it up again in the middle of the closing") {
  const std::string text = pouch("", R"(, "events": [
      {"step": 14, "change": "seam", "length": 0.002, "closing_time": 0.1},
      {"step": 16, "add": {"type": "attachment", "name": "tack", "from": {"body": "front", "on": [40]},
       "to": {"body": "back"}, "mode": "nearest_face", "keep_distance": true}},
      {"step": 22, "change": "seam", "stiffness": 2e5, "over": 0.1}])");
  Scene first = scene_of(text);
  Scene other = parse_scene(text, {}, "s.json", {.threads = 3});
  const pliant_tests::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "checkpoint.pliant";
  for (const int steps : {8, 9, 2, 6, 10}) {
    advance(first, steps);
    advance(other, steps);
    write_checkpoint(file, first);
    CHECK((first.simulation.state().positions.array() == other.simulation.state().positions.array()).all());
    Scene resumed = read_checkpoint(file);
    advance(resumed, 5);
    Scene straight = scene_of(text);
    advance(straight, static_cast<int>(first.simulation.state().step) + 5);
    CHECK((resumed.simulation.state().positions.array() == straight.simulation.state().positions.array()).all());
  }
}

TEST_CASE("options of a seam are listed and changed like those of any group") {
  Scene scene = scene_of(pouch());
  const std::optional<GroupId> seam = scene.simulation.find_group("seam");
  REQUIRE(seam);
  CHECK(parameter(scene.simulation, {*seam, "stiffness"}).value[0] == 1e5);
  CHECK(parameter(scene.simulation, {*seam, "closing_time"}).value[0] == 0.3);
  advance(scene, 5);
  set_parameter(scene.simulation, {*seam, "stiffness"}, {5e4, 0, 0});
  CHECK(scene.simulation.stiffness(*seam) == 5e4);
  set_parameter(scene.simulation, {*seam, "closing_time"}, {0, 0, 0});
  CHECK(scene.simulation.stiffness(*seam) == 5e4);
  advance(scene, 10);
  CHECK(widest_gap(scene) < 2e-3);
  CHECK(scene.simulation.groups().at(*seam).other == BodyId{1});
}

TEST_CASE("slips in attachments give one line with the place and the remedy") {
  struct Slip {
    std::string_view attachment;
    std::string_view start;
    std::string_view part;
  };
  const Slip slips[] = {
      {R"({"from": {"body": "frnt"}, "to": {"body": "back"}})", "s.json: attachments[0].from.body: unknown body 'frnt'",
       "did you mean 'front'?"},
      {R"({"from": {"on": [1]}, "to": {"body": "back"}})", "s.json: attachments[0].from: ", "'body'"},
      {R"({"to": {"body": "back"}})", "s.json: attachments[0]: ", "'from'"},
      {R"({"from": {"body": "front", "on": [100]}, "to": {"body": "back"}})",
       "s.json: attachments[0].from.on[0]: ", "100"},
      {R"({"from": {"body": "front", "on": {"box": {"min": [5, 5, 5], "max": [6, 6, 6]}}}, "to": {"body": "back"}})",
       "s.json: attachments[0].from.on: no vertex is selected", "the body spans"},
      {R"({"from": {"body": "front"}, "to": {"body": "back"}, "mode": "sewn"})",
       "s.json: attachments[0].mode: ", "seam_by_length"},
      {R"({"from": {"body": "front"}, "to": {"body": "back"}, "stiffness": 0})",
       "s.json: attachments[0].stiffness: ", "above 0"},
      {R"({"from": {"body": "front"}, "to": {"body": "back"}, "lenght": 1})",
       "s.json: attachments[0].lenght: unknown key; did you mean 'length'?", ""},
      {R"({"from": {"body": "front", "on": "boundary"}, "to": {"body": "back", "on": [0, 1, 2]}, "mode": "seam"})",
       "s.json: attachments[0]: attachment of body 'front' to body 'back': 'from' selects a loop of 32 vertices, 'to' "
       "a "
       "chain of 3 vertices",
       "select two loops or two open chains"},
      {R"({"from": {"body": "front", "on": [0, 1, 2, 3]}, "to": {"body": "back", "on": [0, 1, 2]}, "mode": "seam"})",
       "s.json: attachments[0]: attachment of body 'front' to body 'back': 'from' selects a chain of 4 vertices, 'to' "
       "a "
       "chain of 3 vertices",
       "seam_by_length"},
      {R"({"name": "front.bending", "from": {"body": "front"}, "to": {"body": "back"}})",
       "s.json: attachments[0].name: the name 'front.bending' is another group's", ""},
  };
  for (const Slip& slip : slips) {
    CAPTURE(slip.attachment);
    const std::string message = message_of(pouch(slip.attachment));
    CAPTURE(message);
    CHECK(message.starts_with(slip.start));
    CHECK(message.find(slip.part) != message.npos);
    CHECK(message.find('\n') == message.npos);
  }
  const std::string message = message_of(pouch("", R"(, "events": [{"time": 1, "change": "seam", "on": [1]}])"));
  CAPTURE(message);
  CHECK(message.starts_with("s.json: events[0].on: unknown key"));
  CHECK(message_of(pouch("", R"(, "events": [{"time": 1, "release": "seam", "vertices": [1]}])"))
            .starts_with("s.json: events[0].release: 'seam' is a group of type attachment"));
}

}  // namespace test_attachment_scenes
