// pliant render: a scene or a run to a picture or a film, without a display.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "appearance_options.h"
#include "commands.h"
#include "import_options.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/files/atomic_file.h"
#include "render/clip.h"
#include "render/film_writer.h"
#include "render/picture_maker.h"
#include "session_film.h"
#include "system/interrupts.h"
#include "terminal.h"

namespace pliant_cli {
namespace {

namespace fs = std::filesystem;
using pliant_render::Clip;

struct RenderArguments : AppearanceArguments {
  fs::path out;               ///< film, picture or folder of pictures
  std::int64_t fps = 30;      ///< frames a second of a film, 1 to 240
  std::int64_t samples = 16;  ///< of a pixel, 1 to 16
  std::optional<std::int64_t>
      frames;              ///< how many, spread evenly, 1 to 100,000; none: all for a film, the last for a picture
  bool sheet = false;      ///< all frames in one picture
  bool turntable = false;  ///< the camera goes around once
  bool timing = false;     ///< print how long each pass of a picture takes
  bool quiet = false;      ///< print warnings and errors only
};

bool is_picture(const RenderArguments& arguments) {
  return pliant_render::film_format_of(arguments.out) == pliant_render::FilmFormat::png;
}

void show(const RenderArguments& arguments, const std::string& what) {
  if (!arguments.quiet && has_error_terminal()) print_to_stderr("\r\x1b[K" + what);
}

/// A camera that turns goes around what moves, wherever that of the scene stands or goes.
void free_camera(const RenderArguments& arguments, pliant::Camera& camera) {
  if (!arguments.turntable) return;
  camera.keyframes.clear();
  camera.position.reset();
  camera.target.reset();
}

Clip clip_of_run(const RenderArguments& arguments) {
  ShownRun run = shown_run(arguments);
  free_camera(arguments, run.appearance.camera);
  pliant::Animation animation = pliant::read_run(arguments.scene);
  const bool is_film = !is_picture(arguments) && animation.times.size() > 1;
  if (is_film) pliant::resample(animation, static_cast<pliant::Real>(arguments.fps));
  pliant_render::RunAnnotations annotations = annotations_of(run, animation);
  return pliant_render::clip_from_animation(std::move(animation), run.appearance, std::move(annotations));
}

/// Steps from frame to frame: a film plays as fast as what it shows happens, where the time step allows it.
std::int64_t steps_a_frame(const pliant::Scene& scene, std::int64_t fps) {
  const double steps = 1 / (static_cast<double>(fps) * scene.simulation.settings().time_step);
  return std::max<std::int64_t>(1, std::llround(std::min(steps, 1e15)));
}

/// By itself a checkpoint is one moment.
pliant::Scene open_checkpoint(const RenderArguments& arguments) {
  const std::optional<std::int64_t> steps = arguments.overrides.steps;
  check_checkpoint(arguments, "change the scene file, and run it");
  if (!steps && !is_picture(arguments)) {
    pliant::fail_input("a checkpoint is one moment; give --out a .png, or --steps up to which it goes on");
  }
  pliant::Scene scene =
      pliant::read_checkpoint(arguments.scene, {.steps = steps, .threads = arguments.overrides.threads});
  if (!steps) scene.steps = scene.simulation.state().step;
  return scene;
}

/// What touches is found by a step, and not kept in a checkpoint.
void check_color_of_moment(const pliant::Scene& scene) {
  const pliant::ColorBy color = scene.view.color;
  if (scene.steps > scene.simulation.state().step) return;
  if (color != pliant::ColorBy::gap && color != pliant::ColorBy::contact_force) return;
  pliant::fail_input(fmt::format("--color: a checkpoint does not hold what touches; give another color, or --steps {}",
                                 scene.steps + 1));
}

Clip clip_of_session(const RenderArguments& arguments) {
  const auto prepare = [&arguments](pliant::Scene& scene) {
    apply_appearance(arguments, scene.view);
    free_camera(arguments, scene.view.camera);
    return steps_a_frame(scene, arguments.fps);
  };
  return clip_from_session(arguments.scene, prepare, [&](std::int64_t step, std::int64_t steps) {
    if (step % 16 == 0) show(arguments, fmt::format("simulating: step {} of {}", step, steps));
    return !pliant_system::was_interrupted();
  });
}

Clip clip_of_scene(const RenderArguments& arguments) {
  pliant::Scene scene = is_checkpoint(arguments) ? open_checkpoint(arguments) : open_scene(arguments);
  print_warnings(scene);
  if (!arguments.quiet) {
    fmt::print("{}", assumptions_text(arguments, scene));
    std::fflush(stdout);  // before it takes its time
  }
  apply_appearance(arguments, scene.view);
  if (is_checkpoint(arguments)) check_color_of_moment(scene);
  free_camera(arguments, scene.view.camera);
  scene.simulation.set_stop(pliant_system::waits_no_longer);
  return pliant_render::clip_from_scene(scene, steps_a_frame(scene, arguments.fps), [&](std::int64_t step) {
    if (step % 16 == 0) show(arguments, fmt::format("simulating: step {} of {}", step, scene.steps));
    return !pliant_system::was_interrupted();
  });
}

/// `count` frames, evenly from the first to the last; one is the last.
std::vector<std::size_t> choose_frames(std::size_t available, std::size_t count) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < count; ++i) {
    chosen.push_back(count == 1 ? available - 1 : (i * (available - 1) + (count - 1) / 2) / (count - 1));
  }
  return chosen;
}

std::vector<std::size_t> frames_to_draw(const RenderArguments& arguments, const Clip& clip) {
  const std::size_t available = clip.frames.size();
  if (!is_picture(arguments) && !arguments.frames) return choose_frames(available, available);
  const auto asked = static_cast<std::size_t>(arguments.frames.value_or(arguments.sheet ? 12 : 1));
  return choose_frames(available, std::min(asked, available));
}

/// Of sheets: about as wide as high.
int columns_of(std::size_t frames) {
  return static_cast<int>(std::ceil(std::sqrt(static_cast<double>(frames))));
}

std::array<std::uint8_t, 3> bytes_of(const pliant::Color& color) {
  const auto byte = [](pliant::Real share) { return static_cast<std::uint8_t>(std::lround(255 * share)); };
  return {byte(color.red), byte(color.green), byte(color.blue)};
}

/// Draws the chosen frames of a clip, one after the other.
class FrameDrawer {
 public:
  FrameDrawer(const RenderArguments& arguments, const Clip& clip, std::vector<std::size_t> chosen,
              const std::array<pliant::Index, 2>& size)
      : arguments_(arguments), clip_(clip), chosen_(std::move(chosen)), maker_(clip.render_mesh, options(size)) {
    if (maker_.texture_error().empty()) return;
    print_to_stderr(fmt::format("warning: {}; the body has its plain color\n", maker_.texture_error()));
  }

  std::size_t count() const { return chosen_.size(); }
  /// Who drew, and whether it had fewer samples than were asked for.
  std::string driver() const {
    const std::string name(pliant::printable(maker_.driver()));
    if (maker_.samples() >= arguments_.samples) return name;
    return fmt::format("{} with {} samples a pixel, all that it has", name, maker_.samples());
  }
  pliant_render::Image draw(std::size_t i) {
    show(arguments_, fmt::format("drawing: frame {} of {}", i + 1, chosen_.size()));
    const pliant_render::ClipFrame& frame = clip_.frames[chosen_[i]];
    return maker_.draw(frame.content, frame.wind, frame.time);
  }
  /// Of the passes of a picture; empty: it was not asked for.
  std::string timing() const { return clock_.text(); }
  /// What the frames show lasts [s].
  pliant::Real duration() const { return clip_.frames[chosen_.back()].time - clip_.frames[chosen_.front()].time; }

 private:
  pliant_render::PictureOptions options(const std::array<pliant::Index, 2>& size) {
    const pliant_render::Bounds bounds = bounds_of(clip_);
    pliant_render::PictureOptions options{clip_.appearance, static_cast<int>(arguments_.samples), bounds,
                                          ground_height(clip_, bounds), color_range(clip_)};
    options.appearance.size = size;
    options.appearance.camera = camera_of(clip_, bounds, size);
    if (arguments_.timing) options.clock = &clock_;
    if (arguments_.turntable) options.appearance.camera.turn_rate = turntable_rate();
    return options;
  }
  /// Once around from the first frame to the one that would follow the last, so that the film can go on from its start.
  pliant::Real turntable_rate() const {
    if (!(duration() > 0)) {
      pliant::fail_input(
          "--turntable: all frames show the same time; a turn needs two at least, by --steps or --frames");
    }
    const auto frames = static_cast<pliant::Real>(count());
    return 360 * (frames - 1) / frames / duration();
  }

  const RenderArguments& arguments_;
  const Clip& clip_;
  std::vector<std::size_t> chosen_;
  pliant_render::PassClock clock_;
  pliant_render::PictureMaker maker_;
};

[[noreturn]] void throw_nothing_written() {
  throw pliant::Error(pliant::ErrorKind::interrupted, "nothing was written");
}

/// Frames beside each other, drawn as small as they are there, in a picture of about the size asked for. Returns what
/// was written. @throws Error (interrupted).
std::string write_sheet(const RenderArguments& arguments, const Clip& clip) {
  const std::vector<std::size_t> chosen = frames_to_draw(arguments, clip);
  const int columns = columns_of(chosen.size());
  const auto cell = [columns](pliant::Index size) { return std::max(16, size / columns); };
  FrameDrawer drawer(arguments, clip, chosen, {cell(clip.appearance.size[0]), cell(clip.appearance.size[1])});
  std::vector<pliant_render::Image> images;
  for (std::size_t i = 0; i < drawer.count() && !pliant_system::was_interrupted(); ++i)
    images.push_back(drawer.draw(i));
  if (pliant_system::was_interrupted()) throw_nothing_written();
  const int gap = std::max(2, clip.appearance.size[0] / 160);
  const pliant_render::Image sheet = contact_sheet(images, columns, gap, bytes_of(clip.appearance.background));
  write_png(arguments.out, sheet);
  return fmt::format("{}{}: {} frames, {} x {} pixels, drawn by {}", drawer.timing(),
                     pliant::printable_place(arguments.out.string()), images.size(), sheet.width, sheet.height,
                     drawer.driver());
}

std::string speed_text(pliant::Real duration, std::size_t frames, std::int64_t fps) {
  const pliant::Real film = static_cast<pliant::Real>(frames - 1) / static_cast<pliant::Real>(fps);
  if (!(duration > 0) || !(film > 0)) return "";
  const pliant::Real factor = duration / film;
  const std::string speed = std::abs(factor - 1) < 0.02 ? "in real time" : fmt::format("{:.3g} times as fast", factor);
  return fmt::format("{:.3g} s {}, ", film, speed);
}

/// The same for a film or separate pictures.
std::string write_film(const RenderArguments& arguments, const Clip& clip) {
  FrameDrawer drawer(arguments, clip, frames_to_draw(arguments, clip), clip.appearance.size);
  pliant_render::FilmWriter writer({arguments.out, clip.appearance.size[0], clip.appearance.size[1],
                                    static_cast<int>(arguments.fps), static_cast<int>(drawer.count())});
  std::size_t drawn = 0;
  for (; drawn < drawer.count() && !pliant_system::was_interrupted(); ++drawn) writer.add(drawer.draw(drawn));
  if (pliant_system::was_interrupted()) {
    const bool are_pictures = is_picture(arguments) || !writer.hint().empty();
    throw pliant::Error(pliant::ErrorKind::interrupted,
                        are_pictures ? fmt::format("{} of {} pictures were written", drawn, drawer.count())
                                     : std::string("no film was written"));
  }
  const std::string written = writer.close();
  show(arguments, "");
  if (!writer.hint().empty()) print_to_stderr("hint: " + writer.hint() + "\n");
  return fmt::format("{}{}: {}{} x {} pixels, drawn by {}", drawer.timing(), pliant::printable_place(written),
                     is_picture(arguments) ? "" : speed_text(drawer.duration(), drawer.count(), arguments.fps),
                     clip.appearance.size[0], clip.appearance.size[1], drawer.driver());
}

void check(const RenderArguments& arguments) {
  check_session(arguments);
  const auto format = pliant_render::film_format_of(arguments.out);
  if (!format) {
    pliant::fail_input(fmt::format("--out: '{}' has no known ending; give .mp4, .webm, .webp, .gif or .png",
                                   pliant::printable_place(arguments.out.string())));
  }
  if (arguments.sheet && *format != pliant_render::FilmFormat::png) {
    pliant::fail_input("--sheet: the frames of a sheet are one picture; give --out a name that ends in .png");
  }
  if (arguments.turntable && is_picture(arguments) && !arguments.sheet && arguments.frames.value_or(1) == 1) {
    pliant::fail_input("--turntable: a single picture does not turn; give --sheet, --frames, or --out a film");
  }
}

/// That pictures can be drawn and written there is known before anything is simulated.
void probe(const RenderArguments& arguments) {
  const fs::path first = arguments.out.parent_path() / (arguments.out.stem().string() + "-0000.png");
  const bool is_numbered = is_picture(arguments) && !arguments.sheet && arguments.frames.value_or(1) > 1;
  const pliant::AtomicFile file(is_numbered ? first : arguments.out);
  const pliant_render::OffscreenContext context;
}

std::string make(const RenderArguments& arguments) {
  probe(arguments);
  std::error_code ignored;
  const bool is_run = fs::is_directory(arguments.scene, ignored);
  const Clip clip = is_run                  ? clip_of_run(arguments)
                    : is_session(arguments) ? clip_of_session(arguments)
                                            : clip_of_scene(arguments);
  if (pliant_system::was_interrupted()) throw_nothing_written();
  return arguments.sheet ? write_sheet(arguments, clip) : write_film(arguments, clip);
}

int render(const RenderArguments& arguments) {
  check(arguments);
  pliant_system::catch_interrupts();
  try {
    const std::string written = make(arguments);
    show(arguments, "");
    fmt::print("{}\n", written);
    return 0;
  } catch (const pliant::Error& error) {
    show(arguments, "");
    if (error.kind() != pliant::ErrorKind::interrupted) throw;
    print_to_stderr(fmt::format("interrupted: {}\n", error.what()));
    return exit_interrupted;
  }
}

}  // namespace

void add_render_command(CLI::App& program, int& exit_code) {
  CLI::App* command =
      program.add_subcommand("render", "Make a picture or a film of a scene or a run, without a display");
  const auto arguments = std::make_shared<RenderArguments>();
  add_scene_arguments(*command, *arguments,
                      std::string(scene_or_run_help) + ", a checkpoint (.pliant) or a recorded session (.session)");
  command->add_option("--out", arguments->out, "Film (.mp4, .webm, .webp, .gif) or picture (.png)")
      ->type_name("FILE")
      ->required();
  add_appearance_options(*command, *arguments);
  add_number(*command, "--fps", arguments->fps, {1, 240},
             "Frames per second of a film, which plays in real time where it can");
  add_number(*command, "--samples", arguments->samples, {1, 16},
             "Samples per pixel; 1: hard edges, in less time; default 16");
  add_number(*command, "--frames", arguments->frames, {1, 100'000},
             "Number of frames, spread evenly; default: all for a film, the last for a picture");
  command->add_flag("--sheet", arguments->sheet, "All frames in one picture; default: 12 of them");
  command->add_flag("--turntable", arguments->turntable, "The camera goes around once while the film lasts");
  command->add_flag("--timing", arguments->timing, "Say how long each pass of a picture takes");
  command->add_flag("--quiet", arguments->quiet, "No progress");
  add_setting_options(*command, *arguments);
  add_simulated_import_options(*command, arguments->import);
  command->footer(
      "Examples:\n"
      "  pliant render curtain_wind --out curtain.mp4\n"
      "  pliant render torus --out torus.png --frames 9 --sheet\n"
      "  pliant render out/flag --out flag.webm --color stretch --size 1920x1080\n"
      "  pliant render out/flag/checkpoint.pliant --out now.png\n"
      "  pliant render pillow --out pillow.webm --turntable");
  command->callback([arguments, &exit_code] { exit_code = render(*arguments); });
}

}  // namespace pliant_cli
