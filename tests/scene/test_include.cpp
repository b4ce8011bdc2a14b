// A scene can include others: what is merged, who wins, and which file an error names.
#include <algorithm>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant_io/files/crc32.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "pliant_io/scene/scene.h"
#include "tests/support/temporary_folder.h"

namespace test_include {

namespace {

using namespace pliant;
using pliant_tests::TemporaryFolder;

constexpr std::string_view base = R"({
  "pliant": 1, "name": "base", "description": "from base", "steps": 11, "gravity": [0, 0, -1],
  "settings": {"iterations": 7, "time_step": 0.5},
  "output": {"every": 4},
  "view": {"camera": {"field_of_view": 50, "up": [0, 1, 0]}, "wireframe": true},
  "bodies": [{"name": "tent", "mesh": {"file": "tent.obj"}, "mass": {"total": 3},
              "constraints": [{"type": "position", "name": "pegs", "on": [0]}]}],
  "forces": [{"type": "wind", "body": "tent"}],
  "moves": [{"group": "pegs", "time": 1, "offset": [0, 0, 1]}]
})";

constexpr std::string_view tent = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

constexpr std::string_view rod =
    R"({"name": "rod", "mesh": {"vertices": [[0, 0, 0], [1, 0, 0]], "edges": [[0, 1]]}, "mass": {"total": 1}})";

/// A folder with a base scene in a folder of its own.
struct Files {
  TemporaryFolder folder;
  Files() {
    std::filesystem::create_directory(folder.path() / "parts");
    folder.write("parts/base.json", base);
    folder.write("parts/tent.obj", tent);
  }
  Scene load(std::string_view text, const SceneOverrides& overrides = {}) const {
    return load_scene(folder.write("scene.json", text), overrides);
  }
  std::string message_of(std::string_view text, const SceneOverrides& overrides = {}) const {
    try {
      load(text, overrides);
    } catch (const Error& error) {
      CHECK(error.kind() == ErrorKind::input);
      std::string message = error.what();
      const std::string prefix = folder.prefix();
      for (std::size_t at = 0; (at = message.find(prefix, at)) != message.npos;) message.erase(at, prefix.size());
      std::ranges::replace(message, '\\', '/');  // on Windows
      return message;
    }
    return "(no error)";
  }
};

std::string including(const std::string& include, const std::string& more = "") {
  return R"({"pliant": 1, "include": )" + include + more + "}";
}

TEST_CASE("an included scene gives all that the scene does not say") {
  const Files files;
  const Scene scene = files.load(including("\"parts/base.json\""));
  CHECK(scene.name == "base");
  CHECK(scene.steps == 11);
  CHECK(scene.simulation.settings().iterations == 7);
  CHECK(scene.simulation.state().vertex_count() == 3);
  CHECK(scene.simulation.forces().size() == 2);
}

TEST_CASE("the including scene wins, key by key; lists go on") {
  const Files files;
  const Scene scene = files.load(
      including("[\"parts/base.json\"]", R"(, "steps": 5, "settings": {"iterations": 2}, "output": {"format": "none"},
      "gravity": null, "view": {"camera": {"field_of_view": 20}}, "bodies": [)" +
                                             std::string(rod) + R"(], "forces": [{"type": "test_force", "body": "rod",
      "vertex": 0, "force": [0, 0, 1]}])"));
  CHECK(scene.description == "from base");
  CHECK(scene.steps == 5);
  CHECK(scene.simulation.settings().iterations == 2);
  CHECK(scene.simulation.settings().time_step == 0.5);
  CHECK(scene.output.every == 4);
  CHECK(scene.output.format == FrameFormat::none);
  CHECK(scene.view.camera.field_of_view == 20);
  CHECK(scene.view.camera.up == Vec3(0, 1, 0));
  CHECK(scene.view.wireframe);
  REQUIRE(scene.simulation.bodies().size() == 2);
  CHECK(scene.simulation.bodies()[0].name == "tent");
  CHECK(scene.simulation.bodies()[1].name == "rod");
  CHECK(scene.simulation.forces().size() == 2);  // wind, test force; no gravity
}

TEST_CASE("values of an included scene are set where it is included") {
  const Files files;
  const std::string include =
      R"({"file": "parts/base.json", "set": {"settings.iterations": 20, "bodies[tent].mass.total": 6, "forces": []}})";
  const Scene scene = files.load(including(include));
  CHECK(scene.simulation.settings().iterations == 20);
  CHECK(scene.simulation.state().masses[0] == 2);
  CHECK(scene.simulation.forces().size() == 1);
}

TEST_CASE("the same scene twice, with other names") {
  const Files files;
  const std::string second = R"({"file": "parts/base.json", "set": {"bodies[0].name": "second", "forces": [],
    "moves": [], "bodies[0].constraints[0].name": "other pegs"}})";
  const Scene scene = files.load(including("[\"parts/base.json\", " + second + "]"));
  CHECK(scene.simulation.bodies()[1].name == "second");
  CHECK(scene.source.texts.size() == 2);
  CHECK(scene.files.size() == 1);
}

TEST_CASE("paths of --set count through all lists") {
  const Files files;
  const std::string text = including("\"parts/base.json\"", R"(, "bodies": [)" + std::string(rod) + "]");
  CHECK(files.load(text, {.set = {"bodies[1].mass.total=8"}}).simulation.state().masses.back() == 4);
  CHECK(files.load(text, {.set = {"bodies[tent].mass.total=6"}}).simulation.state().masses[0] == 2);
  CHECK(files.load(text, {.set = {"forces=[]", "moves=[]"}}).simulation.forces().size() == 1);
  CHECK(files.load(text, {.set = {"gravity[2]=-3"}}).simulation.forces().size() == 2);
  CHECK(files.load(text, {.set = {"settings.iterations=3"}}).simulation.settings().iterations == 3);
  CHECK(files.load(text, {.set = {"view.camera.up[0]=3"}}).view.camera.up == Vec3(3, 1, 0));
  CHECK(files.message_of(text, {.set = {"bodies[2].name=x"}}).find("entries 0 to 1") != std::string::npos);
}

TEST_CASE("a force that names no body is on the only one of its own text") {
  const Files files;
  const Scene scene = files.load(including("[\"chain\", \"bar\"]"));
  CHECK(scene.simulation.bodies().size() == 2);
}

TEST_CASE("errors name the file where the value stands") {
  const Files files;
  files.folder.write("parts/slip.json", R"({"pliant": 1, "settings": {"iteratons": 3}})");
  CHECK(files.message_of(including("\"parts/slip.json\"")).starts_with("parts/slip.json: settings.iteratons: unknown"));
  files.folder.write("parts/syntax.json", "{\n\"pliant\" 1}");
  CHECK(files.message_of(including("\"parts/syntax.json\"")).starts_with("parts/syntax.json:2:10: "));
  CHECK(files.message_of(including(R"({"file": "parts/base.json", "set": {"steps": -1}})")) ==
        "scene.json: include.set.steps: -1 is out of range; give a number from 0 to 9007199254740992");
  CHECK(files.message_of(including(R"([{"file": "parts/base.json", "set": {"stepz": 1}}])"))
            .starts_with("scene.json: include[0].set.stepz: unknown key"));
  CHECK(files.message_of(including(R"({"file": "parts/base.json", "set": {"bodies[0].mass.total": 0}})"))
            .starts_with("parts/base.json: bodies[0].mass: "));
  CHECK(
      files.message_of(including("\"parts/none.json\"")).starts_with("scene.json: include: parts/none.json: no such"));
  CHECK(files.message_of(including("\"curtan\"")).find("did you mean 'curtain'?") != std::string::npos);
  CHECK(files.message_of(including("\"parts\"")).find("is a directory") != std::string::npos);
  CHECK(files.message_of(including("7")).starts_with("scene.json: include: found a number; give the path of a scene"));
  CHECK(files.message_of(including(R"({"fil": "x"})")).starts_with("scene.json: include.fil: unknown key"));
  CHECK(files.message_of(including(R"({"file": "parts/base.json", "set": 3})"))
            .starts_with("scene.json: include.set: found a number; give an object"));
  CHECK(files.message_of(including("[]")).starts_with("scene.json: the key 'bodies' is missing"));
  files.folder.write("parts/base.json", std::string(base).replace(std::string(base).find("tent.obj"), 8, "no.obj"));
  CHECK(files.message_of(including("\"parts/base.json\""))
            .starts_with("parts/base.json: bodies[0].mesh.file: parts/no.obj: no such file"));
}

TEST_CASE("old names of an included scene give way to new ones of the scene itself") {
  const Files files;
  files.folder.write("old.json", R"({"pliant": 1, "include": "chain", "view": {"colour": "speed", "legend": false}})");
  const Scene scene = files.load(including("\"old.json\"", R"(, "view": {"color": "energy"})"));
  CHECK(scene.view.color == ColorBy::energy);
  CHECK_FALSE(scene.view.legend);
  REQUIRE(scene.warnings.size() == 1);
  CHECK(scene.warnings[0].find("old.json: view.colour: 'colour' is called 'color' now") != std::string::npos);
}

TEST_CASE("messages name the text that a value stands in, however deep it was merged") {
  const Files files;
  const auto with_view = [&](const std::string& base_view, const std::string& view) {
    files.folder.write("b.json", R"({"pliant": 1, "include": "chain", "view": )" + base_view + "}");
    return files.message_of(including("\"b.json\"", ", \"view\": " + view));
  };
  CHECK(with_view(R"({"camera": {"up": [0, 1, 0], "field_of_view": 200}})", R"({"camera": {"up": [1, 0, 0]}})")
            .starts_with("b.json: view.camera.field_of_view: 200 is out of range"));
  CHECK(with_view(R"({"camera": {"up": [0, 1, 0]}})", R"({"camera": {"field_of_view": 200}})")
            .starts_with("scene.json: view.camera.field_of_view: 200 is out of range"));
  CHECK(with_view(R"({"front": [0, 0, 2]})", R"({"wireframe": true})").starts_with("b.json: view.front[2]: is no"));
  CHECK(with_view("7", R"({"wireframe": true})").starts_with("b.json: view: found a number; give an object"));
  CHECK(with_view("{}", "[]").starts_with("scene.json: view: found a list; give an object"));
  files.folder.write("b.json", R"({"pliant": 1, "include": "chain", "events": [{"step": 1, "remove": "x"}]})");
  CHECK(files.message_of(including("\"b.json\"", R"(, "events": [{"step": 0, "remove": "y"}])"))
            .starts_with("scene.json: events[0].remove: no group"));
  CHECK(files.message_of(including("\"b.json\"", R"(, "events": [{"step": 3, "remove": "y"}])"))
            .starts_with("b.json: events[0].remove: no group"));
  CHECK(files.message_of(including("\"b.json\"", R"(, "events": {})")).starts_with("scene.json: events: found an obj"));
}

TEST_CASE("scenes that include themselves, too deep or too often") {
  const Files files;
  CHECK(files.message_of(including("\"scene.json\"")) ==
        "scene.json: include: a scene cannot include itself: scene.json > scene.json; take one out");
  files.folder.write("a.json", including("\"parts/../b.json\""));
  files.folder.write("b.json", including("\"scene.json\""));
  CHECK(files.message_of(including("\"a.json\"")).starts_with("b.json: include: a scene cannot include itself: scene"));
  for (int i = 0; i < 30; ++i) {
    files.folder.write(fmt::format("n{}.json", i), including(fmt::format("\"n{}.json\"", i + 1)));
  }
  CHECK(files.message_of(including("\"n0.json\"")).find("more than 16 scenes include each other") != std::string::npos);
  for (int i = 0; i < 12; ++i) {
    files.folder.write(fmt::format("m{}.json", i), including(fmt::format("[\"m{0}.json\", \"m{0}.json\"]", i + 1)));
  }
  files.folder.write("m12.json", R"({"pliant": 1})");
  CHECK(files.message_of(including("\"m0.json\"")).find("more than 256 scenes are included") != std::string::npos);
}

TEST_CASE("a built-in scene can be included, and a file of its name is preferred") {
  const Files files;
  const std::string text = including(R"({"file": "chain", "set": {"steps": 3}})");
  CHECK(files.load(text).steps == 3);
  files.folder.write("chain", base);
  CHECK(files.message_of(text).find("tent.obj: no such file") != std::string::npos);
}

TEST_CASE("the source has every text, and the files are known by their sums") {
  const Files files;
  Scene scene = files.load(including("[\"parts/base.json\", \"chain\"]", R"(, "name": "mine")"));
  REQUIRE(scene.files.size() == 1);
  CHECK(scene.files[0].path == (files.folder.path() / "parts" / "tent.obj").string());
  CHECK(scene.files[0].size == tent.size());
  CHECK(scene.files[0].crc32 == crc32(tent));
  CHECK(scene.source.texts.size() == 3);
  std::filesystem::remove(files.folder.path() / "parts" / "base.json");
  std::filesystem::remove(files.folder.path() / "scene.json");
  Scene again = parse_scene(scene.source);
  CHECK(again.name == "mine");
  for (int i = 0; i < 3; ++i) {
    scene.step();
    again.step();
  }
  CHECK(scene.simulation.state().positions == again.simulation.state().positions);
}

TEST_CASE("a name means the file beside the scene that says it, from wherever it is read") {
  const Files files;
  const auto chain = [](int links) {
    return fmt::format(
        R"({{"pliant": 1, "bodies": [{{"name": "rope {0}", "mesh": {{"shape": "chain", "links": {0}}}, "mass": {{"total": 1}}}}]}})",
        links);
  };
  files.folder.write("b.json", chain(5));
  files.folder.write("parts/b.json", chain(13));
  files.folder.write("parts/c.json", R"({"pliant": 1, "include": "b.json"})");
  files.folder.write("a.json", R"({"pliant": 1, "include": ["b.json", "parts/c.json"]})");
  const std::filesystem::path before = std::filesystem::current_path();
  for (const std::filesystem::path& from : {before, files.folder.path(), files.folder.path() / "parts"}) {
    std::filesystem::current_path(from);
    const Scene scene = load_scene(std::filesystem::relative(files.folder.path() / "a.json"));
    std::filesystem::current_path(before);
    CHECK(scene.simulation.state().vertex_count() == 6 + 14);
  }
}

TEST_CASE("the CRC-32 of gzip") {
  CHECK(crc32("123456789") == 0xCBF43926U);  // the check value of the polynomial
  CHECK(crc32("") == 0);
}

}  // namespace

}  // namespace test_include
