// Whose the files in a run's folder are: what a run wrote is replaced by the next one, and nothing else is touched.
#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant/mesh/shapes.h"
#include "pliant_io/mesh/mesh_file.h"
#include "pliant_io/recorder/recorder.h"
#include "pliant_io/recorder/run_files.h"
#include "tests/support/temporary_folder.h"

namespace test_run_files {

namespace {

using namespace pliant;
using pliant_tests::TemporaryFolder;
using Names = std::vector<std::string>;

Names names_in(const std::filesystem::path& folder) {
  Names names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

Simulation two_bodies() {
  Simulation simulation;
  BodyOptions sheet;
  sheet.name = "sheet";
  simulation.add_body(grid({.columns = 3, .rows = 2}), Mass::total(1), sheet);
  BodyOptions rope;
  rope.name = "rope";
  simulation.add_body(chain({.links = 2}), Mass::total(1), rope);
  return simulation;
}

void begin(const TemporaryFolder& folder, const std::string& format) {
  RunInfo info;
  info.frame_format = format;
  begin_run(folder.path(), info, two_bodies());
}

void check_refused(const TemporaryFolder& folder, const std::string& format, const std::string& what) {
  const Names before = names_in(folder.path());
  try {
    begin(folder, format);
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::output);
    CHECK_MESSAGE(std::string(error.what()).find(what) != std::string::npos, error.what());
  }
  CHECK(names_in(folder.path()) == before);
}

TEST_CASE("a run's folder is made, with what stands there from the start on") {
  const TemporaryFolder folder;
  const auto runs = folder.path() / "a" / "b";
  RunInfo info;
  info.frame_format = "npy";
  const Simulation simulation = two_bodies();
  begin_run(runs, info, simulation);
  CHECK(names_in(runs) == Names{"mesh.obj", "run.json"});
  CHECK(TemporaryFolder::read(runs / "run.json").find("\"outcome\": \"running\"") != std::string::npos);
  const Mesh mesh = read_mesh(runs / "mesh.obj");
  CHECK(mesh.vertices == simulation.state().positions);
  CHECK(mesh.triangles.size() == 4);
  CHECK(mesh.edges.size() == 2);
  info.outcome = Outcome::ok;
  end_run(runs, info, simulation);
  CHECK(TemporaryFolder::read(runs / "run.json").find("\"outcome\": \"ok\"") != std::string::npos);
}

TEST_CASE("the mesh of a run keeps names of materials, but names no library that is not beside it") {
  const TemporaryFolder folder;
  const std::string text = "mtllib cloth.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
  for (const int body_count : {1, 2}) {
    Simulation simulation;
    for (int i = 0; i < body_count; ++i) simulation.add_body(read_mesh(folder.write("a.obj", text)), Mass::total(1));
    RunInfo info;
    info.frame_format = "obj";
    const auto run = folder.path() / std::to_string(body_count);
    begin_run(run, info, simulation);
    make_obj_writer(run, simulation.bodies())->add(simulation.state().positions);
    for (const char* name : {"mesh.obj", "frame_00000.obj"}) {
      const std::string written = TemporaryFolder::read(run / name);
      CHECK(written.find("usemtl red\n") != written.npos);
      CHECK(written.find("mtllib") == written.npos);
    }
  }
}

TEST_CASE("without frames there is no mesh") {
  const TemporaryFolder folder;
  begin(folder, "none");
  CHECK(names_in(folder.path()) == Names{"run.json"});
  CHECK(run_files("none") == Names{"run.json", "measurements.csv", "checkpoint.pliant"});
  CHECK(frames_name("none").empty());
}

TEST_CASE("what an earlier run wrote is removed, and nothing else") {
  const TemporaryFolder folder;
  const auto earlier = [&](const std::string& json, const Names& names) {
    std::filesystem::remove_all(folder.path());
    std::filesystem::create_directory(folder.path());
    folder.write("run.json", json);
    for (const std::string& name : names) folder.write(name, "x");
    prepare_run_folder(folder.path(), "none");
    return names_in(folder.path());
  };
  const std::string head = R"({"scene": "a", "bodies": [], "settings": {"time_step": 0.1}, )";
  const Names all = {"frame_00000.obj", "frame_00001.obj",  "frame_00003.obj",  "frame_1.obj",
                     "frame_0000x.obj", "frame_00000.ply",  "frames.npy",       "frames.pc2",
                     "mesh.obj",        "measurements.csv", "frame_123456.obj", "notes.txt"};

  // As version 0.1.0 wrote it.
  CHECK(earlier(head + R"("outcome": "ok", "output": {"format": "npy", "every": 1}, "totals": {"frames": 3}})",
                {"frames.npy", "mesh.obj", "frame_00000.obj"}) == Names{"frame_00000.obj", "mesh.obj", "run.json"});

  const std::string objects =
      R"("output": {"format": "obj", "every": 2, "files": ["frame_*.obj", "mesh.obj", "run.json", "measurements.csv"]}, )";
  const std::string tidy = objects + R"("totals": {"frames": 2}})";
  Names left = all;
  std::erase(left, "mesh.obj");
  std::erase(left, "frame_00000.obj");
  std::erase(left, "frame_00001.obj");
  left.push_back("run.json");
  std::ranges::sort(left);
  const auto without_measurements = [&] {
    Names names = left;
    std::erase(names, "measurements.csv");
    return names;
  };
  CHECK(earlier(head + R"("outcome": "ok", )" + tidy, all) == without_measurements());
  // One that was killed: 0, 1, ... without a gap.
  CHECK(earlier(head + R"("outcome": "running", )" + objects + R"("totals": {"frames": 0}})", all) ==
        without_measurements());
  // What it was writing goes as well.
  CHECK(earlier(head + R"("outcome": "running", )" + objects + R"("totals": {"frames": 0}})",
                {"frame_00000.obj", "frame_00001.obj.tmp-0", "mesh.obj.tmp-3", "run.json.tmp-0", "notes.txt.tmp-0"}) ==
        Names{"notes.txt.tmp-0", "run.json"});
  // A name that no run has is not followed.
  folder.write("notes.txt", "x");
  CHECK(earlier(head + R"("outcome": "ok", "output": {"format": "npy", "every": 1, "files": ["notes.txt", "../x"]},
                "totals": {"frames": 3}})",
                {"notes.txt"}) == Names{"notes.txt", "run.json"});
}

TEST_CASE("a run follows a run of any format") {
  const TemporaryFolder folder;
  for (const std::string format : {"npy", "obj", "pc2", "none", "npy"}) {
    CAPTURE(format);
    begin(folder, format);
    for (const std::string& name : run_files(format)) {
      if (name == "run.json" || name == "mesh.obj") continue;
      folder.write(name.find('*') == std::string::npos ? name : frame_file_name(0, format), "x");
    }
    CHECK(names_in(folder.path()).size() == run_files(format).size());
  }
}

TEST_CASE("a file that no run wrote is not replaced") {
  for (const char* name : {"mesh.obj", "frames.npy", "measurements.csv"}) {
    const TemporaryFolder folder;
    folder.write(name, "x");
    check_refused(folder, "npy", name);
  }
  const TemporaryFolder folder;
  folder.write("frame_00007.obj", "x");
  check_refused(folder, "obj", "frame_00007.obj");
  begin(folder, "npy");  // is not in its way
  CHECK(names_in(folder.path()) == Names{"frame_00007.obj", "mesh.obj", "run.json"});
  check_refused(folder, "obj", "frame_00007.obj");
}

TEST_CASE("a run.json of something else is not replaced") {
  for (const char* text : {"", "{", "[]", "{}", R"({"scene": 3})", R"({"scene": "a", "output": {"format": "npy"}})",
                           R"({"scripts": {"run": "x"}})"}) {
    CAPTURE(text);
    const TemporaryFolder folder;
    folder.write("run.json", text);
    check_refused(folder, "npy", "run.json was not written by a run");
  }
  const TemporaryFolder folder;
  CHECK_THROWS_AS(prepare_run_folder(folder.write("file", "x"), "npy"), Error);
}

}  // namespace

}  // namespace test_run_files
