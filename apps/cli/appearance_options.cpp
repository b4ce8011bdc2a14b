#include "appearance_options.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "commands.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/recorder/run_files.h"
#include "terminal.h"

namespace pliant_cli {
namespace {

namespace fs = std::filesystem;

/// "1280x720".
std::array<pliant::Index, 2> parse_size(const std::string& text) {
  constexpr pliant::Index least = 16, most = 8192;
  std::array<pliant::Index, 2> size{0, 0};
  std::size_t place = 0;
  bool is_good = !text.empty();
  for (const char c : text) {
    if (c == 'x' && place == 0) {
      ++place;
    } else if (c >= '0' && c <= '9' && size[place] <= most) {
      size[place] = 10 * size[place] + (c - '0');
    } else {
      is_good = false;
    }
  }
  if (!is_good || place != 1 || std::ranges::min(size) < least || std::ranges::max(size) > most) {
    pliant::fail_input(fmt::format("--size: '{}' is not a size; give width x height from {} to {}, as in 1280x720",
                                   pliant::printable(text), least, most));
  }
  return size;
}

/// The scene that the run was made from, at its start; none where no checkpoint has it.
std::optional<pliant::Scene> scene_of_run(const AppearanceArguments& arguments) {
  check_import(arguments);
  const pliant::SceneOverrides& overrides = arguments.overrides;
  const bool has_others =
      overrides.steps || overrides.time_step || overrides.iterations || overrides.tolerance || overrides.threads ||
      overrides.backend ||
      !std::ranges::all_of(overrides.set, [](const std::string& set) { return set.starts_with("view."); });
  if (has_others) {
    pliant::fail_input(
        fmt::format("{}: a run is shown as it was recorded; of the options that change a scene only --set of what "
                    "begins with 'view.' counts; to change more, give its scene",
                    pliant::printable_place(arguments.scene)));
  }
  const fs::path checkpoint = fs::path(arguments.scene) / pliant::checkpoint_name;
  std::error_code ignored;
  if (!fs::exists(checkpoint, ignored)) {
    if (overrides.set.empty()) return {};
    pliant::fail_input(fmt::format("{}: no such file, so the view of its scene is not known; leave --set out",
                                   pliant::printable_place(checkpoint.string())));
  }
  try {
    pliant::SceneSource source = pliant::read_checkpoint(checkpoint).source;
    for (const std::string& set : overrides.set) source.overrides.set.push_back(set);
    return pliant::parse_scene(std::move(source));
  } catch (const pliant::Error& error) {
    if (!overrides.set.empty()) throw;
    // The frames can be shown whatever has become of the scene.
    print_to_stderr("note: the view of the scene is not known, so the default is taken: " +
                    pliant::printable_place(error.what(), message_limit) + "\n");
    return {};
  }
}

}  // namespace

void add_appearance_options(CLI::App& command, AppearanceArguments& arguments) {
  command.add_option("--size", arguments.size, "Width and height in pixels; default: the scene's, or 1280x720")
      ->type_name("WIDTHxHEIGHT");
  add_choice(command, "--color,--colour", arguments.color,
             "What colors show: none, stretch, energy, speed, gap or contact_force");
  add_choice(command, "--shading", arguments.shading, "smooth, or flat: each face has one shade");
  command.add_flag("--wireframe", arguments.wireframe, "Draw the edges too");
}

void apply_appearance(const AppearanceArguments& arguments, pliant::ViewSettings& appearance) {
  if (!arguments.size.empty()) appearance.size = parse_size(arguments.size);
  if (arguments.color) appearance.color = *arguments.color;
  if (arguments.shading) appearance.shading = *arguments.shading;
  if (arguments.wireframe) appearance.wireframe = true;
}

ShownRun shown_run(const AppearanceArguments& arguments) {
  ShownRun run{{}, scene_of_run(arguments)};
  if (run.scene) run.appearance = run.scene->view;
  apply_appearance(arguments, run.appearance);
  return run;
}

pliant_render::RunAnnotations annotations_of(ShownRun& run, const pliant::Animation& animation) {
  if (!run.scene) return {};
  try {
    return pliant_render::annotate_run(*std::exchange(run.scene, std::nullopt), animation);
  } catch (const pliant::Error& error) {
    if (error.kind() != pliant::ErrorKind::input) throw;
    print_to_stderr(
        "note: pins, wind and colliders are not shown: " + pliant::printable_place(error.what(), message_limit) + "\n");
    return {};
  }
}

}  // namespace pliant_cli
