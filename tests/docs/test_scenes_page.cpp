// docs/scenes.md shows a scene that can be read; all pages on scenes say of every option what the program says.
#include <filesystem>
#include <sstream>
#include <string>

#include <doctest/doctest.h>

#include "pliant/collision/colliders/builtin.h"
#include "pliant/constraints/builtin.h"
#include "pliant/forces/builtin.h"
#include "pliant/mesh/shapes.h"
#include "pliant_io/mesh/mesh_file.h"
#include "pliant_io/scene/animation_options.h"
#include "pliant_io/scene/event_options.h"
#include "pliant_io/scene/scene.h"
#include "tests/support/temporary_folder.h"

namespace test_scenes_page {

namespace {

using namespace pliant;
using pliant_tests::TemporaryFolder;

/// docs/scenes.md, and behind it the pages of docs/scenes/, whose headings are a level below its own.
std::string all_pages() {
  const std::string docs = std::string(PLIANT_SOURCE_DIR) + "/docs/";
  std::string text = TemporaryFolder::read(docs + "scenes.md");
  for (const auto& file : std::filesystem::directory_iterator(docs + "scenes")) {
    std::istringstream lines(TemporaryFolder::read(file.path()));
    for (std::string line; std::getline(lines, line);) text += (line.starts_with('#') ? "#" : "") + line + '\n';
  }
  return text;
}

const std::string& page() {
  static const std::string text = all_pages();
  return text;
}

/// The example between ```jsonc and ```, without its comments.
std::string example() {
  const std::size_t begin = page().find("```jsonc\n") + 9;
  std::istringstream lines(page().substr(begin, page().find("```", begin) - begin));
  std::string scene;
  for (std::string line; std::getline(lines, line);) scene += line.substr(0, line.find("//")) + '\n';
  return scene;
}

std::string number_text(Real number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

std::string default_text(const Values& values) {
  return values.empty() ? "" : number_text(values[0]);
}
std::string default_text(const Vec3& v) {
  return "[" + number_text(v[0]) + ", " + number_text(v[1]) + ", " + number_text(v[2]) + "]";
}
template <class Number, std::size_t n>
std::string default_text(const std::array<Number, n>& numbers) {
  std::string text;
  for (const Number number : numbers) text += (text.empty() ? "[" : ", ") + number_text(static_cast<Real>(number));
  return text + "]";
}
std::string default_text(const Color& c) {
  return "[" + number_text(c.red) + ", " + number_text(c.green) + ", " + number_text(c.blue) + "]";
}
std::string default_text(const bool& flag) {
  return flag ? "true" : "false";
}
std::string default_text(const Selection&) {
  return "\"all\"";
}
template <class Option>
std::string default_text(const Option& option) {
  if constexpr (std::is_enum_v<Option>) {
    return '"' + std::string(choice_names(option)[static_cast<std::size_t>(option)]) + '"';
  } else if constexpr (std::is_arithmetic_v<Option>) {
    return number_text(static_cast<Real>(option));
  } else {
    return "";
  }
}

/// The tables of options stand under their type's heading, in the chapter of their kind.
template <class Options>
void check_rows(std::string_view heading = "", std::string_view chapter = "") {
  const std::size_t begin = heading.empty() ? 0 : page().find(heading, page().find(chapter));
  CHECK_MESSAGE(begin != std::string::npos, heading);
  if (begin == std::string::npos) return;
  const std::string section = page().substr(begin, page().find("\n#", begin + 1) - begin);
  const std::string& place = heading.empty() ? page() : section;
  const Options options;
  Options::visit(options, [&](const OptionInfo& info, const auto& option) {
    std::string row = "| `" + std::string(info.name) + "` | " + std::string(info.unit) + " | " + default_text(option) +
                      " | " + std::string(info.doc) + " |";
    CHECK_MESSAGE(place.find(row) != std::string::npos, row);
  });
}

template <class Shape>
void check_shape() {
  check_rows<Shape>("\n#### `" + std::string(Shape::shape) + "`\n");
}

/// Types of constraints, of forces or of colliders.
template <class... Type>
void check_types(std::string_view chapter, std::tuple<Type...>*) {
  (check_rows<Type>("\n### `" + std::string(Type::info.name) + "`\n", chapter), ...);
}

TEST_CASE("the example is a sound scene") {
  const TemporaryFolder folder;
  folder.write("pennant.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
  Scene scene = parse_scene(example(), folder.path(), "example.json");
  CHECK(scene.simulation.bodies().size() == 3);
  for (int i = 0; i < 100; ++i) scene.step();
  CHECK(scene.simulation.state().positions.allFinite());
}

TEST_CASE("the tables list every option") {
  check_rows<SolverSettings>();
  check_rows<OutputSettings>();
  check_rows<ViewSettings>();
  check_rows<Camera>();
  check_rows<CameraKeyframe>();
  check_rows<ImportOptions>();
  check_shape<GridOptions>();
  check_shape<PanelOptions>();
  check_shape<NetOptions>();
  check_shape<PillowOptions>();
  check_shape<TorusOptions>();
  check_shape<SphereOptions>();
  check_shape<CylinderOptions>();
  check_shape<CapsuleOptions>();
  check_shape<TubeOptions>();
  check_shape<BarOptions>();
  check_shape<ChainOptions>();
  check_rows<MoveOptions>();
  check_rows<Keyframe>();
  check_rows<Rotation>();
  check_rows<FollowOptions>();
  check_rows<FileOptions>();
  check_rows<RampOptions>();
  check_rows<SteadyAnimation>("\n### Animation\n");
  check_rows<FrameAnimation>("\n### Animation\n");
  check_types("\n## Constraints\n", static_cast<BuiltinConstraints*>(nullptr));
  check_types("\n## Attachments\n", static_cast<std::tuple<Attachment>*>(nullptr));
  check_types("\n## Forces\n", static_cast<BuiltinForces*>(nullptr));
  check_types("\n## Colliders\n", static_cast<BuiltinColliders*>(nullptr));
  check_rows<ContactSettings>("\n### `contact`\n");
  check_rows<BodyContact>("\n### `contact` of a body\n");
}

}  // namespace

}  // namespace test_scenes_page
