#include "scene_options.h"

#include <charconv>
#include <filesystem>
#include <limits>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant/scene/builtin_scenes.h"
#include "pliant/scene/nearest_names.h"

namespace pliant_cli {
namespace {

namespace fs = std::filesystem;

/// Reads the whole of a text, or says what is wanted in its place.
template <class Number>
Number to_number(const std::string& option, const std::string& text, std::string_view wanted) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error == std::errc{} && stop == end) return number;
  pliant::fail_input(fmt::format("{}: '{}' {}; give {}", option, pliant::printable(text, 60),
                                 error == std::errc::result_out_of_range ? "is out of range" : "is not what is wanted",
                                 wanted));
}

template <class Number>
void add_number_option(CLI::App& command, const std::string& name, std::optional<Number>& number,
                       const std::string& help, const std::string& wanted) {
  const auto take = [&number, name, wanted](const std::string& text) {
    number = to_number<Number>(name, text, wanted);
  };
  command.add_option_function<std::string>(name, take, help)->type_name(std::is_integral_v<Number> ? "INT" : "FLOAT");
}

/// The largest is named, since some try it for "for ever".
template <class Number>
std::string wanted_whole() {
  return fmt::format("a whole number up to {}, without point and exponent", std::numeric_limits<Number>::max());
}

}  // namespace

void add_number(CLI::App& command, const std::string& name, std::optional<std::int64_t>& number,
                const std::string& help) {
  add_number_option(command, name, number, help, wanted_whole<std::int64_t>());
}

void add_number(CLI::App& command, const std::string& name, std::optional<pliant::Index>& number,
                const std::string& help) {
  add_number_option(command, name, number, help, wanted_whole<pliant::Index>());
}

void add_number(CLI::App& command, const std::string& name, std::optional<pliant::Real>& number,
                const std::string& help) {
  add_number_option(command, name, number, help, "a number, such as 0.01 or 1e-2");
}

void add_scene_arguments(CLI::App& command, SceneArguments& arguments) {
  command.add_option("scene", arguments.scene, "A scene file, or the name of a built-in scene")->required();
  command
      .add_option("--set", arguments.overrides.set,
                  "PATH=VALUE: take another value, such as settings.iterations=20, bodies[0].mass.total=2 or "
                  "'bodies[curtain].constraints[bend].stiffness=1e-3'; may be given several times")
      ->type_name("PATH=VALUE")
      ->expected(1)
      ->take_all();
}

void add_setting_options(CLI::App& command, SceneArguments& arguments) {
  pliant::SceneOverrides& overrides = arguments.overrides;
  add_number(command, "--steps", overrides.steps, "Steps to take");
  add_number(command, "--iterations", overrides.iterations, "Local and global steps in each step");
  add_number(command, "--time-step", overrides.time_step, "Length of a step [s]");
  add_number(command, "--tolerance", overrides.tolerance,
             "Iterate no further below this residual [N]; 0: only at exact rest");
  add_number(command, "--threads", overrides.threads, "0: one a processor; results do not depend on it");
  add_choice(command, "--backend", overrides.backend, "Library that factorizes: automatic, eigen or cholmod");
}

pliant::Scene open_scene(const SceneArguments& arguments) {
  std::error_code ignored;
  const fs::file_status status = fs::status(arguments.scene, ignored);
  if (fs::exists(status) && !fs::is_directory(status)) return pliant::load_scene(arguments.scene, arguments.overrides);
  std::vector<std::string_view> names;
  for (const pliant::BuiltinScene& scene : pliant::builtin_scenes()) {
    if (scene.name == arguments.scene) return pliant::parse_scene(scene.text, {}, scene.name, arguments.overrides);
    names.push_back(scene.name);
  }
  const bool is_hidden = status.type() != fs::file_type::not_found;
  if (is_hidden) return pliant::load_scene(arguments.scene, arguments.overrides);  // says what is wrong with it
  pliant::fail_input(
      fmt::format("{}: neither a file nor a built-in scene; `pliant scenes` lists those, the nearest first: {}",
                  pliant::printable_place(arguments.scene), pliant::nearest_names_text(arguments.scene, names)));
}

}  // namespace pliant_cli
