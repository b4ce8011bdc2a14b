// The README shows programs, scenes and a table that exist: what stands there is what is built.
#include <fstream>
#include <sstream>

#include <doctest/doctest.h>

#include "pliant/constraints/builtin.h"
#include "pliant_io/scene/scene.h"

namespace test_readme {

namespace {

using namespace pliant;

std::string read(const std::string& path) {
  std::ifstream file(std::string(PLIANT_SOURCE_DIR) + "/" + path);
  REQUIRE_MESSAGE(file.good(), path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// What the README shows of a program: from its first #include, without the markers of snippets.
std::string shown_part(const std::string& program) {
  std::stringstream lines(program.substr(program.find("#include")));
  std::string shown;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("//!") == std::string::npos) shown += line + "\n";
  }
  return shown;
}

template <class Constraint>
std::string table_row() {
  std::string unit;
  const Constraint options;
  Constraint::visit(options, [&unit](const OptionInfo& info, const auto&) {
    if (info.name == "stiffness") unit = info.unit;
  });
  const ConstraintInfo& info = Constraint::info;
  std::stringstream row;
  row << "| `" << info.name << "` | " << info.reduction << " | " << info.set << " | " << info.energy << " | " << unit
      << " | " << info.source << " |\n";
  return row.str();
}

}  // namespace

TEST_CASE("the README shows the first program and the scene of the examples") {
  const std::string readme = read("README.md");
  CHECK(readme.find(shown_part(read("examples/first_steps.cpp"))) != std::string::npos);
  CHECK(readme.find(read("examples/my_scene.json")) != std::string::npos);
}

TEST_CASE("the installed example is the first program") {
  CHECK(read("examples/consumer/main.cpp") == read("examples/first_steps.cpp"));
}

TEST_CASE("the README's table has every built-in constraint") {
  const std::string readme = read("README.md");
  std::apply(
      [&readme](const auto&... types) {
        const auto check = [&readme](const std::string& row) {
          CHECK_MESSAGE(readme.find(row) != std::string::npos, row);
        };
        (check(table_row<std::remove_cvref_t<decltype(types)>>()), ...);
      },
      BuiltinConstraints{});
}

TEST_CASE("the README's scene runs") {
  Scene scene = load_scene(std::string(PLIANT_SOURCE_DIR) + "/examples/my_scene.json");
  for (int i = 0; i < 5; ++i) scene.step();
  CHECK(scene.simulation.state().positions.allFinite());
}

}  // namespace test_readme
