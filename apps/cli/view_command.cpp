// pliant view: a window in which a scene is simulated, or a run played.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "appearance_options.h"
#include "commands.h"
#include "import_options.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "render/scalar_fields.h"
#include "sweep/measurement_table.h"
#include "system/interrupts.h"
#include "viewer/live_source.h"
#include "viewer/playback.h"
#include "viewer/recent_files.h"
#include "viewer/recent_pictures.h"
#include "viewer/viewer.h"
#include "viewer/window_settings.h"

namespace pliant_cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_name = 48;             // in the list of scenes [bytes]
constexpr const char* first_scene = "curtain_wind";  // behind the list of scenes

struct ViewArguments : AppearanceArguments {
  std::optional<std::int64_t>
      samples;             ///< of a pixel, 1 to 16; none: 4 on a graphics card, 1 where the processor draws
  bool is_paused = false;  ///< begin paused
};

void check(const ViewArguments& arguments) {
  check_import(arguments);
  check_session(arguments);
  check_checkpoint(arguments, "change it in the window, or its scene file");
  if (arguments.overrides.steps) pliant::fail_input("--steps: a window goes on until it is closed; leave it out");
}

bool is_run(const ViewArguments& arguments) {
  std::error_code ignored;
  return fs::is_directory(arguments.scene, ignored);
}

pliant::Scene make_scene(const ViewArguments& arguments) {
  pliant::Scene scene = is_checkpoint(arguments) ? pliant::read_checkpoint(arguments.scene) : open_scene(arguments);
  print_warnings(scene);
  apply_appearance(arguments, scene.view);
  return scene;
}

/// Hands out a scene that is there already, and makes it anew from then on.
pliant_viewer::MakeScene scene_maker(const ViewArguments& arguments, std::shared_ptr<pliant::Scene> first) {
  return [arguments, first = std::move(first), source = std::optional<pliant::SceneSource>()]() mutable {
    if (const std::shared_ptr<pliant::Scene> ready = std::exchange(first, nullptr)) {
      if (is_checkpoint(arguments)) source = ready->source;
      return std::move(*ready);
    }
    if (!source) return make_scene(arguments);
    pliant::Scene scene = parse_scene(*source);  // what a checkpoint goes on from begins like this
    apply_appearance(arguments, scene.view);
    return scene;
  };
}

/// What the window shows.
struct Shown {
  ViewArguments arguments;
  std::unique_ptr<pliant_viewer::ViewSource> source;
  std::string greeting = {};  ///< what was assumed, and warnings
};

Shown show_run(const ViewArguments& arguments) {
  ShownRun run = shown_run(arguments);
  const pliant::ViewSettings appearance = run.appearance;
  if (arguments.color) pliant_render::check_known_of_runs(*arguments.color);
  pliant::Animation animation = pliant::read_run(arguments.scene);
  pliant_render::RunAnnotations annotations = annotations_of(run, animation);
  auto playback = std::make_unique<pliant_viewer::Playback>(
      pliant_render::RunFrames(std::move(animation), std::move(annotations)), appearance, !arguments.is_paused);
  const fs::path measurements = fs::path(arguments.scene) / "measurements.csv";
  if (std::error_code ignored; fs::exists(measurements, ignored)) {
    playback->set_measured({playback->name(), pliant_sweep::read_measurements(measurements)});
  }
  return {arguments, std::move(playback)};
}

int threads_beside(const pliant_viewer::Window& window) {
  return window.is_software() ? pliant_viewer::spare_threads() : 0;
}

/// A recorded session, and its scene as it was opened.
struct OpenedSession {
  pliant_viewer::SessionRecord record;
  std::shared_ptr<pliant::Scene> first;
  pliant_viewer::MakeScene make;  ///< it anew
};

OpenedSession open_session(const ViewArguments& arguments) {
  OpenedSession session{pliant_viewer::read_session_record(arguments.scene), {}, {}};
  session.make = [arguments, make = scene_maker_of(session.record, arguments.scene)] {
    pliant::Scene scene = make();
    apply_appearance(arguments, scene.view);
    return scene;
  };
  session.first = std::make_shared<pliant::Scene>(session.make());
  return session;
}

Shown show_session(const ViewArguments& arguments, OpenedSession session, pliant_viewer::Window& window) {
  const auto make = [first = std::move(session.first), make = std::move(session.make)]() mutable {
    if (const std::shared_ptr<pliant::Scene> ready = std::exchange(first, nullptr)) return std::move(*ready);
    return make();
  };
  std::string greeting =
      fmt::format("a recorded session of {} steps; whatever you do takes over", session.record.steps);
  return {arguments,
          std::make_unique<pliant_viewer::LiveSource>(make, threads_beside(window), !arguments.is_paused,
                                                      pliant_viewer::Window::wake, std::move(session.record)),
          std::move(greeting)};
}

Shown show_scene(const ViewArguments& arguments, std::shared_ptr<pliant::Scene> scene, pliant_viewer::Window& window) {
  std::string greeting = short_assumptions_text(arguments, *scene);
  return {arguments,
          std::make_unique<pliant_viewer::LiveSource>(scene_maker(arguments, std::move(scene)), threads_beside(window),
                                                      !arguments.is_paused, pliant_viewer::Window::wake),
          std::move(greeting)};
}

/// The folder of a file, with ~ for one's own.
std::string shown_folder(const fs::path& file) {
  const std::string folder = file.parent_path().string();
  const char* home = std::getenv("HOME");
  if (home == nullptr || home[0] == '\0' || !folder.starts_with(home)) return pliant::printable_place(folder);
  const std::string rest = folder.substr(std::string(home).size());
  return pliant::printable_place(rest.empty() || rest[0] == '/' ? "~" + rest : folder);
}

/// What was opened of late, but for what is shown, then the built-in scenes.
std::vector<pliant_viewer::OpenableScene> openable_scenes(const ViewArguments& shown) {
  std::vector<pliant_viewer::OpenableScene> scenes;
  for (const fs::path& file : pliant_viewer::read_recent_files(pliant_viewer::recent_files_path())) {
    if (std::error_code ignored; fs::equivalent(file, shown.scene, ignored)) continue;
    scenes.push_back({.name = pliant::printable_place(file.filename().string(), longest_name),
                      .description = shown_folder(file),
                      .opens = file.string(),
                      .picture = pliant_viewer::recent_picture_file(pliant_viewer::recent_pictures_folder(), file)});
  }
  const auto first = scenes.size();
  for (const pliant::BuiltinScene& scene : pliant::builtin_scenes()) {
    scenes.push_back({std::string(scene.name), pliant::scene_description(scene.text, scene.name)});
  }
  if (first > 0) {
    scenes.front().heading = "Recent";
    scenes[first].heading = "Built in";
  }
  return scenes;
}

void remember_file(const fs::path& file) {
  pliant_viewer::remember_file(pliant_viewer::recent_files_path(), file);
}

bool is_builtin(const ViewArguments& shown) {
  return std::ranges::count(pliant::builtin_scenes(), shown.scene, &pliant::BuiltinScene::name) > 0;
}

/// The files that a window shows and saves, and how they look.
class SeenFiles {
 public:
  explicit SeenFiles(const ViewArguments& shown) {
    if (is_builtin(shown)) return;
    remember_file(shown.scene);
    files_.emplace_back(shown.scene);
  }
  /// From any thread.
  void add_saved(const fs::path& file) {
    remember_file(file);
    const std::lock_guard lock(mutex_);
    files_.push_back(file);
  }
  void keep(const pliant_render::Image& picture) {
    const std::lock_guard lock(mutex_);
    for (const fs::path& file : files_) {
      pliant_viewer::keep_recent_picture(pliant_viewer::recent_pictures_folder(), file, picture);
    }
  }

 private:
  std::mutex mutex_;
  std::vector<fs::path> files_;
};

/// As it was asked for on the command line, for what was chosen in the window: no option of the scene's own holds.
ViewArguments arguments_for(const std::string& what, const ViewArguments& first) {
  ViewArguments arguments;
  const char* home = std::getenv("HOME");
  arguments.scene = home != nullptr && what.starts_with("~/") ? home + what.substr(1) : what;
  arguments.samples = first.samples;
  return arguments;
}

/// Shows one thing after another, until the window is closed.
int show(pliant_viewer::Window& window, Shown shown, bool chooses_scene) {
  while (true) {
    const auto seen = std::make_shared<SeenFiles>(shown.arguments);
    std::optional<Shown> next;
    std::string film;
    pliant_viewer::ViewerOptions options;
    options.appearance = shown.source->appearance();
    if (shown.arguments.samples) options.samples = static_cast<int>(*shown.arguments.samples);
    options.scenes = openable_scenes(shown.arguments);
    options.chooses_scene = std::exchange(chooses_scene, false);
    options.greeting = shown.greeting;
    options.saved = [seen](const fs::path& file) { seen->add_saved(file); };
    options.looked = [seen](const pliant_render::Image& picture) { seen->keep(picture); };
    options.settings_file = pliant_viewer::window_settings_path();
    options.open = [&](const std::string& what) -> std::string {
      try {
        const ViewArguments arguments = arguments_for(what, shown.arguments);
        check(arguments);
        if (is_session(arguments)) {
          next = show_session(arguments, open_session(arguments), window);
          return "";
        }
        next = is_run(arguments)
                   ? show_run(arguments)
                   : show_scene(arguments, std::make_shared<pliant::Scene>(make_scene(arguments)), window);
        return "";
      } catch (const std::exception& error) {
        return error.what();
      }
    };
    window.set_title(shown.source->name() + " - Pliant");
    {
      pliant_viewer::Viewer viewer(window, *shown.source, std::move(options));
      viewer.run(pliant_system::was_interrupted);
      film = viewer.finish_film();
    }
    if (!next && !film.empty()) fmt::print("{}\n", film);
    if (!next) break;
    shown = std::move(*next);
    if (!film.empty()) shown.greeting = film + (shown.greeting.empty() ? "" : "\n" + shown.greeting);
  }
  return pliant_system::was_interrupted() ? exit_interrupted : 0;
}

int view_run(const ViewArguments& arguments) {
  Shown shown = show_run(arguments);
  const std::array<pliant::Index, 2> size = shown.source->appearance().size;
  pliant_viewer::Window window("Pliant", size[0], size[1]);
  return show(window, std::move(shown), false);
}

int view_session(const ViewArguments& arguments) {
  OpenedSession session = open_session(arguments);
  const std::array<pliant::Index, 2> size = session.first->view.size;
  pliant_viewer::Window window("Pliant", size[0], size[1]);
  return show(window, show_session(arguments, std::move(session), window), false);
}

int view_scene(const ViewArguments& given) {
  ViewArguments arguments = given;
  if (given.scene.empty()) arguments.scene = first_scene;
  auto scene = std::make_shared<pliant::Scene>(make_scene(arguments));
  fmt::print("{}", assumptions_text(arguments, *scene));
  std::fflush(stdout);  // before the window opens
  pliant_viewer::Window window("Pliant", scene->view.size[0], scene->view.size[1]);
  return show(window, show_scene(arguments, std::move(scene), window), given.scene.empty());
}

int view(const ViewArguments& arguments) {
  check(arguments);
  pliant_system::catch_interrupts();
  pliant_viewer::limit_software_driver();
  pliant_viewer::Window::require_display();  // before anyone waits for a scene to be read
  if (is_session(arguments)) return view_session(arguments);
  return is_run(arguments) ? view_run(arguments) : view_scene(arguments);
}

}  // namespace

void add_view_command(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("view", "Open a window: pull at a scene or a mesh, or play a run");
  const auto arguments = std::make_shared<ViewArguments>();
  add_scene_arguments(*command, *arguments, std::string(scene_or_run_help) + "; none: a list to choose from");
  command->get_option("scene")->required(false);
  add_appearance_options(*command, *arguments);
  add_number(*command, "--samples", arguments->samples, {1, 16},
             "Samples per pixel; default: 4 on a graphics card, 1 where the processor draws");
  command->add_flag("--paused", arguments->is_paused, "Start paused; the space bar continues");
  add_simulated_import_options(*command, arguments->import);
  add_setting_options(*command, *arguments);
  command->footer(
      "A file that ends in .obj, .ply, .off, .stl, .msh, .mesh, .vtu, .vtk, .node or .ele is a mesh, simulated as "
      "cloth, a\n"
      "skin or a solid; a folder is a run, played as it was recorded; .pliant is a checkpoint that the window has "
      "saved, and .session a session that it has recorded, which is replayed. The key H shows what mouse and keys do.\n"
      "Other files are opened by dropping them onto the window, and the list of scenes by Ctrl + O.\n"
      "Examples:\n"
      "  pliant view\n"
      "  pliant view curtain_wind\n"
      "  pliant view shirt.obj --up y\n"
      "  pliant view out/flag --color stretch");
  command->callback([arguments, &exit_code] { exit_code = view(*arguments); });
}

}  // namespace pliant_cli
