// Animated bodies in scenes: frames of every kind, steady motions, what is wrong with them, and the same bits when a
// run is taken up again.
#include <array>
#include <cmath>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/mesh/shapes.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/mesh/mesh_file.h"
#include "pliant_io/mesh/mesh_sequence.h"
#include "pliant_io/scene/scene.h"
#include "tests/scene/whole_scenes.h"
#include "tests/support/temporary_folder.h"

namespace test_animations {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// A floor of 6 × 6 vertices below a sheet; the text stands for its animation, and for more of the floor.
std::string scene_text(std::string_view animation, std::string_view more = "", std::string_view events = "") {
  return fmt::format(R"({{"pliant": 1, "steps": 60, "settings": {{"iterations": 8, "threads": 1}},
  "contact": {{"surfaces": true, "friction": 0.5}},
  "bodies": [
    {{"name": "floor", "mesh": {{"file": "floor.obj"}}, "animation": {}{}}},
    {{"name": "sheet", "mesh": {{"shape": "grid", "columns": 6, "rows": 6, "size": [0.4, 0.4], "plane": "xy"}},
     "transform": {{"translate": [-0.2, -0.2, 0.1]}}, "mass": {{"area_density": 0.3}},
     "constraints": [{{"type": "triangle_strain", "stiffness": 300}}, {{"type": "hinge", "stiffness": 1e-4}}]}}],
  "events": [{}]}})",
                     animation, more, events);
}

/// Where vertices of the floor are in frame i: it rises, leans over and returns.
Positions frame_of(const Mesh& mesh, int i) {
  Positions x = mesh.vertices;
  const Real share = std::sin(0.3 * i);
  x.col(2) += share * (0.1 * x.col(0) + Positions::Constant(x.rows(), 3, 0.05).col(0));
  return x;
}

constexpr int frame_count = 8;

class Files {
 public:
  Files() {
    mesh = grid({.columns = 6, .rows = 6, .plane = Plane::xy});
    mesh.vertices.rowwise() -= Vec3(0.5, 0.5, 0).transpose();
    write_mesh(folder.path() / "floor.obj", mesh, mesh.vertices);
    for (int i = 0; i < frame_count; ++i) write_frame(fmt::format("walk_{}.obj", i + 3), frame_of(mesh, i));
    folder.write("walk_last.obj", "not a mesh, and no number");
  }

  void write_frame(std::string_view name, const Positions& x) const { write_mesh(folder.path() / name, mesh, x); }

  Scene parse(std::string_view animation, std::string_view more = "", std::string_view events = "") const {
    return parse_scene(scene_text(animation, more, events), folder.path(), "s.json");
  }

  /// The message of a scene that is refused.
  std::string refusal(std::string_view animation, std::string_view more = "", std::string_view events = "") const {
    try {
      parse(animation, more, events);
    } catch (const Error& error) {
      CHECK(error.kind() == ErrorKind::input);
      return error.what();
    }
    return "(no error)";
  }

  TemporaryFolder folder;
  Mesh mesh;
};

Positions floor_of(const Scene& scene) {
  return scene.simulation.state().positions.topRows(scene.simulation.bodies()[0].mesh.vertex_count());
}

/// The frame at a time [s], linear between two; frames are as exact as text.
void check_floor(const Scene& scene, const Mesh& mesh, Real frames_per_second, Real last = frame_count - 1) {
  const Real place = std::min(last, frames_per_second * scene.simulation.state().time);
  const int frame = static_cast<int>(place + 1e-9);
  const Real share = place - frame;
  const Positions expected = (1 - share) * frame_of(mesh, frame) + share * frame_of(mesh, frame + 1);
  CHECK((floor_of(scene) - expected).cwiseAbs().maxCoeff() < 1e-6);
}

}  // namespace

TEST_CASE("animations: meshes of a sequence are frames, linear in time between them") {
  const Files files;
  Scene scene = files.parse(R"({"frames": "walk_*.obj", "frames_per_second": 20})");
  CHECK(scene.warnings.empty());
  CHECK(scene.files.size() == frame_count + 1);  // with floor.obj
  CHECK(scene.group_names.front() == "floor.animation");
  check_floor(scene, files.mesh, 20);
  for (int i = 0; i < 30; ++i) {
    scene.step();
    check_floor(scene, files.mesh, 20);
  }
}

TEST_CASE("animations: the time of a frame follows from its number, whatever numbers are missing") {
  const Files files;
  for (const char* gone : {"walk_4.obj", "walk_6.obj"}) std::filesystem::remove(files.folder.path() / gone);
  Scene scene = files.parse(R"({"frames": "walk_*.obj", "frames_per_second": 20})");
  for (int i = 0; i < 6; ++i) scene.step();  // 0.1 s: frame 2, whose number is 5
  check_floor(scene, files.mesh, 20);
  for (int i = 0; i < 15; ++i) scene.step();  // past the last one
  check_floor(scene, files.mesh, 20);
}

TEST_CASE("animations: a repeated one begins anew") {
  const Files files;
  files.write_frame("walk_10.obj", frame_of(files.mesh, 0));  // the eighth is the first one again
  Scene scene = files.parse(R"({"frames": "walk_*.obj", "frames_per_second": 60, "repeat": true})");
  Positions first;
  for (int i = 1; i <= 16; ++i) {
    scene.step();
    if (i == 2) first = floor_of(scene);
  }
  CHECK((floor_of(scene) - first).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("animations: frames are scaled and turned as the mesh file is, and go through the transform") {
  const Files files;
  const std::string text = R"({"pliant": 1, "contact": {"surfaces": true}, "bodies": [
    {"mesh": {"file": "floor.obj", "scale": 2, "up": "y"}, "transform": {"translate": [0, 0, 1]},
     "animation": {"frames": "walk_*.obj", "frames_per_second": 60}}]})";
  Scene scene = parse_scene(text, files.folder.path(), "s.json");
  for (int i = 0; i <= 2; ++i) {
    const Positions x = frame_of(files.mesh, i);
    const Positions now = floor_of(scene);
    for (Index v = 0; v < static_cast<Index>(x.rows()); ++v) {
      const Vec3 expected(2 * x(v, 0), -2 * x(v, 2), 2 * x(v, 1) + 1);
      REQUIRE((row(now, v) - expected).norm() < 1e-5);
    }
    scene.step();
  }
}

TEST_CASE("animations: velocities move a body on and turn it, and events act on it as on pins") {
  const Files files;
  Scene scene = files.parse(R"({"velocity": [0.1, 0, 0], "angular_velocity": [0, 0, 1], "center": [0, 0, 0]})",
                            R"(, "mass": {"total": 5})", R"({"step": 30, "stop": "floor.animation"},
                            {"step": 40, "move": "floor.animation", "offset": [0, 0, -0.1], "over": 0.1})");
  for (int i = 0; i < 60; ++i) scene.step();
  const Eigen::AngleAxis<Real> turn(0.5, Vec3::UnitZ());
  const Vec3 expected = turn * row(files.mesh.vertices, 0) + Vec3(0.05, 0, -0.1);
  CHECK((row(floor_of(scene), 0) - expected).norm() < 1e-6);
}

TEST_CASE("animations: a still body holds a sheet, and says so where nothing can meet it") {
  const Files files;
  Scene scene = files.parse("{}", R"(, "contact": {"distance": 0.02})");
  for (int i = 0; i < (runs_whole_scenes ? 60 : 5); ++i) scene.step();
  if (runs_whole_scenes) {
    CHECK(scene.simulation.state().positions.bottomRows(36).col(2).minCoeff() > 0);
    CHECK(scene.simulation.state().positions.bottomRows(36).col(2).maxCoeff() < 0.05);
  }
  const std::string text = R"({"pliant": 1, "bodies": [{"mesh": {"shape": "sphere"}, "animation": {}}]})";
  CHECK(parse_scene(text, {}, "s.json").warnings ==
        std::vector<std::string>{
            R"(s.json: bodies[0].animation: nothing meets an animated body; set "contact": {"surfaces": true})"});
}

TEST_CASE("animations: a run that is resumed at every tenth step has the same bits") {
  const Files files;
  for (const char* animation : {R"({"frames": "walk_*.obj", "frames_per_second": 12})",
                                R"({"frames": "walk_*.obj", "frames_per_second": 48, "repeat": true})",
                                R"({"velocity": [0, 0, 0.02], "angular_velocity": [0, 0.1, 1]})"}) {
    CAPTURE(animation);
    const TemporaryFolder folder;
    Scene scene = files.parse(animation);
    const std::int64_t steps = runs_whole_scenes ? 60 : 12;
    std::vector<State> states = {scene.simulation.state()};
    Index active = 0;
    for (std::int64_t step = 0; step < steps; ++step) {
      if (step % 10 == 0) write_checkpoint(folder.path() / fmt::format("{}.pliant", step), scene);
      active += scene.step().contact.active;
      states.push_back(scene.simulation.state());
    }
    if (runs_whole_scenes) CHECK(active > 100);
    for (std::int64_t begin = 0; begin < steps; begin += 10) {
      CAPTURE(begin);
      Scene resumed = read_checkpoint(folder.path() / fmt::format("{}.pliant", begin));
      for (std::int64_t i = begin; i < steps; ++i) {
        resumed.step();
        REQUIRE(resumed.simulation.state().positions == states[static_cast<std::size_t>(i + 1)].positions);
        REQUIRE(resumed.simulation.state().velocities == states[static_cast<std::size_t>(i + 1)].velocities);
      }
    }
  }
}

TEST_CASE("animations: every slip gives one line with the place and the remedy") {
  const Files files;
  files.write_frame("odd_1.obj", files.mesh.vertices);
  const Mesh other = grid({.columns = 3, .rows = 3});
  write_mesh(files.folder.path() / "odd_2.obj", other, other.vertices);
  write_mesh(files.folder.path() / "small_1.obj", other, other.vertices);
  files.write_frame("twin_1.obj", files.mesh.vertices);
  files.write_frame("twin_01.obj", files.mesh.vertices);
  files.folder.write("nan_1.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  files.folder.write("broken.pc2", "POINTCACHE2");
  std::filesystem::create_directory(files.folder.path() / "run");
  struct Slip {
    const char* animation;
    const char* place;
    const char* what;
  };
  constexpr auto in_frames = "s.json: bodies[0].animation.frames: ";
  const std::array slips{
      Slip{"3", "s.json: bodies[0].animation: ", "object"},
      Slip{R"({"frame": "walk_*.obj"})", "s.json: bodies[0].animation.frame: ", "did you mean 'frames'?"},
      Slip{R"({"frames": "run_*.obj"})", in_frames, "no file has that name with a number in place of the star"},
      Slip{R"({"frames": "away/walk_*.obj"})", in_frames, "the folder cannot be read"},
      Slip{R"({"frames": "w*_*.obj"})", in_frames, "a pattern has one star"},
      Slip{R"({"frames": "walk_3.obj"})", in_frames, "whose numbers a star stands for"},
      Slip{R"({"frames": "run"})", in_frames, "run/frames.npy"},
      Slip{R"({"frames": ""})", in_frames, "the path is empty"},
      Slip{R"({"frames": "gone.npy"})", in_frames, "gone.npy"},
      Slip{R"({"frames": "broken.pc2"})", in_frames, "broken.pc2"},
      Slip{R"({"frames": "odd_*.obj"})", in_frames, "9 vertices, but"},
      Slip{R"({"frames": "small_*.obj"})", in_frames, "frames of 9 vertices for a body of 36"},
      Slip{R"({"frames": "twin_*.obj"})", in_frames, "have one number"},
      Slip{R"({"frames": "nan_*.obj"})", in_frames, "nan_1.obj"},
      Slip{R"({"frames": "walk_*.stp"})", in_frames, "no file has that name"},
      Slip{R"({"frames": "small_*.obj", "repeat": true})", in_frames, "9 vertices"},
      Slip{R"({"frames": "twin_0*.obj", "repeat": true})", in_frames, "one frame cannot be repeated"},
      Slip{R"({"frames": "walk_*.obj", "frames_per_second": 0})",
           "s.json: bodies[0].animation.frames_per_second: ", "0"},
      Slip{R"({"frames": "walk_*.obj", "velocity": [1, 0, 0]})", "s.json: bodies[0].animation.velocity: ", "unknown"},
      Slip{R"({"frames_per_second": 10})", "s.json: bodies[0].animation.frames_per_second: ", "there are no frames"},
      Slip{R"({"repeat": true})", "s.json: bodies[0].animation.repeat: ", "there are no frames"},
      Slip{R"({"velocity": 3})", "s.json: bodies[0].animation.velocity: ", ""},
      Slip{R"({"name": ""})", "s.json: bodies[0].animation.name: ", "empty name"}};
  for (const Slip& slip : slips) {
    CAPTURE(std::string(slip.animation));
    const std::string message = files.refusal(slip.animation);
    CAPTURE(message);
    CHECK(message.starts_with(slip.place));
    CHECK(message.find(slip.what) != message.npos);
    CHECK(message.find('\n') == message.npos);
  }
  const std::string start = files.refusal(R"({"frames": "walk_*.obj"})", R"(, "start_positions": [[0, 0, 0]])");
  CHECK(start.find("bodies[0].start_positions: ") != start.npos);
  const std::string moved = files.refusal("{}", "", R"({"step": 1, "move": "floor", "offset": [0, 0, 1]})");
  CHECK(moved.find("floor.animation") != moved.npos);
  try {
    parse_scene(R"({"pliant": 1, "bodies": [{"mesh": {"shape": "grid"}, "mass": {"total": 1}}],
                    "colliders": [{"type": "mesh"}]})",
                {}, "s.json");
    FAIL("a collider of type mesh was taken");
  } catch (const Error& error) {
    CHECK(std::string(error.what()) ==
          "s.json: colliders[0].type: a mesh that others meet is a body with the key 'animation'; move it to 'bodies'");
  }
}

TEST_CASE("animations: a sequence is found by its numbers") {
  const TemporaryFolder folder;
  for (const char* name :
       {"a_10.obj", "a_9.obj", "a_.obj", "a_1b.obj", "a_-1.obj", "b_1.obj", "a_1234567890123456.obj"}) {
    folder.write(name, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  }
  const std::vector<SequenceFile> files = sequence_files(folder.path() / "a_*.obj");
  REQUIRE(files.size() == 2);
  CHECK(files[0].number == 9);
  CHECK(files[1].path == folder.path() / "a_10.obj");
  CHECK(is_mesh_sequence("a/b_*.obj"));
  CHECK_FALSE(is_mesh_sequence("a*/b.obj"));
  CHECK(read_mesh_sequence(files, {.frames_per_second = 2}).time(1) == 0.5);
  CHECK_THROWS_AS(read_mesh_sequence(files, {.frames_per_second = 0}), Error);
}

}  // namespace test_animations
