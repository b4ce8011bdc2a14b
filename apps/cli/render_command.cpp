// pliant render: a scene or a run to a picture or a film, without a display.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "commands.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant/recorder/run_files.h"
#include "pliant/scene/checkpoint.h"
#include "render/film_writer.h"
#include "render/picture_maker.h"
#include "render/take.h"
#include "scene_options.h"
#include "terminal.h"

namespace pliant_cli {
namespace {

namespace fs = std::filesystem;
using pliant_render::Take;

struct RenderArguments : SceneArguments {
  fs::path out;
  std::string size;
  std::optional<pliant::ColourBy> colour;
  std::optional<pliant::Shading> shading;
  bool wireframe = false;
  std::int64_t fps = 30;
  std::int64_t samples = 4;
  std::optional<std::int64_t> frames;
  bool sheet = false;
  bool quiet = false;
};

template <class Number>
void check_range(std::string_view option, Number value, Number least, Number most) {
  if (value >= least && value <= most) return;
  pliant::fail_input(fmt::format("{}: {} is out of range; give {} to {}", option, value, least, most));
}

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
    pliant::fail_input(fmt::format("--size: '{}' is no size; give width x height from {} to {}, as in 1280x720",
                                   pliant::printable(text), least, most));
  }
  return size;
}

void apply(const RenderArguments& arguments, pliant::ViewSettings& look) {
  if (!arguments.size.empty()) look.size = parse_size(arguments.size);
  if (arguments.colour) look.colour = *arguments.colour;
  if (arguments.shading) look.shading = *arguments.shading;
  if (arguments.wireframe) look.wireframe = true;
}

void show(const RenderArguments& arguments, const std::string& what) {
  if (!arguments.quiet && has_error_terminal()) print_to_stderr("\r\x1b[K" + what);
}

/// Of the scene that the run was made from, as its checkpoint has it.
pliant::ViewSettings view_of_run(const RenderArguments& arguments) {
  const pliant::SceneOverrides& overrides = arguments.overrides;
  const bool has_others =
      overrides.steps || overrides.time_step || overrides.iterations || overrides.tolerance || overrides.threads ||
      overrides.backend ||
      !std::ranges::all_of(overrides.set, [](const std::string& set) { return set.starts_with("view."); });
  if (has_others) {
    pliant::fail_input(
        fmt::format("{}: a run is shown as it was recorded; of --set only what begins with 'view.' "
                    "counts; to change more, give its scene",
                    pliant::printable_place(arguments.scene)));
  }
  const fs::path checkpoint = fs::path(arguments.scene) / pliant::checkpoint_name;
  std::error_code ignored;
  if (!fs::exists(checkpoint, ignored)) {
    if (overrides.set.empty()) return {};
    pliant::fail_input(fmt::format("{}: no such file, so the view of its scene is not known; leave --set out",
                                   pliant::printable_place(checkpoint.string())));
  }
  pliant::Scene scene = pliant::read_checkpoint(checkpoint);
  if (overrides.set.empty()) return scene.view;
  pliant::SceneSource source = scene.source;
  for (const std::string& set : overrides.set) source.overrides.set.push_back(set);
  return pliant::parse_scene(std::move(source)).view;
}

Take take_of_run(const RenderArguments& arguments) {
  pliant::ViewSettings look = view_of_run(arguments);
  apply(arguments, look);
  pliant::Animation animation = pliant::read_run(arguments.scene);
  if (animation.times.size() > 1) pliant::resample(animation, static_cast<pliant::Real>(arguments.fps));
  return pliant_render::take_animation(animation, look);
}

/// Steps from frame to frame: a film plays as fast as what it shows happens, where the time step allows it.
std::int64_t steps_a_frame(const pliant::Scene& scene, std::int64_t fps) {
  const double steps = 1 / (static_cast<double>(fps) * scene.simulation.settings().time_step);
  return std::max<std::int64_t>(1, std::llround(std::min(steps, 1e15)));
}

Take take_of_scene(const RenderArguments& arguments) {
  pliant::Scene scene = open_scene(arguments);
  apply(arguments, scene.view);
  return pliant_render::take_scene(scene, steps_a_frame(scene, arguments.fps), [&](std::int64_t step) {
    if (step % 16 == 0) show(arguments, fmt::format("simulating: step {} of {}", step, scene.steps));
    return !was_interrupted();
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

std::vector<std::size_t> frames_to_draw(const RenderArguments& arguments, const Take& take) {
  const bool is_picture = pliant_render::film_format_of(arguments.out) == pliant_render::FilmFormat::png;
  const std::size_t available = take.frames.size();
  if (!is_picture && !arguments.frames) return choose_frames(available, available);
  const auto asked = static_cast<std::size_t>(arguments.frames.value_or(arguments.sheet ? 12 : 1));
  return choose_frames(available, std::min(asked, available));
}

/// Of sheets: about as wide as high.
int columns_of(std::size_t frames) {
  return static_cast<int>(std::ceil(std::sqrt(static_cast<double>(frames))));
}

std::array<std::uint8_t, 3> bytes_of(const pliant::Colour& colour) {
  const auto byte = [](pliant::Real share) { return static_cast<std::uint8_t>(std::lround(255 * share)); };
  return {byte(colour.red), byte(colour.green), byte(colour.blue)};
}

std::string write_pictures(const RenderArguments& arguments, const Take& take, pliant_render::PictureMaker& maker) {
  const std::vector<std::size_t> chosen = frames_to_draw(arguments, take);
  const auto draw = [&](std::size_t i) {
    show(arguments, fmt::format("drawing: frame {} of {}", i + 1, chosen.size()));
    const pliant_render::TakeFrame& frame = take.frames[chosen[i]];
    return maker.draw(frame.content, frame.wind);
  };
  if (arguments.sheet) {
    std::vector<pliant_render::Image> images;
    const int columns = columns_of(chosen.size());
    for (std::size_t i = 0; i < chosen.size() && !was_interrupted(); ++i) {
      images.push_back(
          scaled_down(draw(i), std::max(1, take.look.size[0] / columns), std::max(1, take.look.size[1] / columns)));
    }
    if (images.empty()) return "";
    write_png(arguments.out,
              contact_sheet(images, columns, std::max(2, take.look.size[0] / 160), bytes_of(take.look.background)));
    return arguments.out.string();
  }
  pliant_render::FilmWriter writer({arguments.out, take.look.size[0], take.look.size[1],
                                    static_cast<int>(arguments.fps), static_cast<int>(chosen.size())});
  for (std::size_t i = 0; i < chosen.size() && !was_interrupted(); ++i) writer.add(draw(i));
  if (was_interrupted()) return "";
  std::string written = writer.close();
  if (!writer.hint().empty()) print_to_stderr("\r\x1b[Khint: " + writer.hint() + "\n");
  return written;
}

void check(const RenderArguments& arguments) {
  const auto format = pliant_render::film_format_of(arguments.out);
  if (!format) {
    pliant::fail_input(fmt::format("--out: '{}' has no known ending; give .mp4, .webm, .gif or .png",
                                   pliant::printable_place(arguments.out.string())));
  }
  if (arguments.sheet && *format != pliant_render::FilmFormat::png) {
    pliant::fail_input("--sheet: the frames of a sheet are one picture; give --out a name that ends in .png");
  }
  check_range<std::int64_t>("--fps", arguments.fps, 1, 240);
  check_range<std::int64_t>("--samples", arguments.samples, 1, 16);
  if (arguments.frames) check_range<std::int64_t>("--frames", *arguments.frames, 1, 100'000);
}

int render(const RenderArguments& arguments) {
  check(arguments);
  catch_interrupts();
  std::error_code ignored;
  const Take take = fs::is_directory(arguments.scene, ignored) ? take_of_run(arguments) : take_of_scene(arguments);
  const pliant_render::PictureOptions options{take.look, static_cast<int>(arguments.samples), bounds_of(take),
                                              ground_height(take), colour_range(take)};
  pliant_render::PictureMaker maker(take.scenery, options);
  const std::string written = was_interrupted() ? "" : write_pictures(arguments, take, maker);
  show(arguments, "");
  if (was_interrupted()) {
    print_to_stderr("interrupted: nothing was written\n");
    return exit_interrupted;
  }
  fmt::print("{}: {} x {} pixels, drawn by {}\n", pliant::printable_place(written), take.look.size[0],
             take.look.size[1], pliant::printable(maker.driver()));
  return 0;
}

}  // namespace

void add_render_command(CLI::App& program, int& exit_code) {
  CLI::App* command =
      program.add_subcommand("render", "Make a picture or a film of a scene or a run, without a display");
  const auto arguments = std::make_shared<RenderArguments>();
  add_scene_arguments(*command, *arguments);
  command->add_option("--out", arguments->out, "Film (.mp4, .webm, .gif) or picture (.png)")->required();
  command->add_option("--size", arguments->size, "Width and height in pixels; default: the scene's, or 1280x720");
  add_choice(*command, "--colour", arguments->colour, "What colours tell: none, stretch, energy or speed");
  add_choice(*command, "--shading", arguments->shading, "smooth, or flat: each face by itself");
  command->add_flag("--wireframe", arguments->wireframe, "Draw the edges too");
  add_number(*command, "--fps", arguments->fps, "Frames a second of a film, which plays in real time where it can");
  add_number(*command, "--samples", arguments->samples, "Of a pixel; 1: hard edges, in less time; default 4");
  add_number(*command, "--frames", arguments->frames,
             "That many, evenly from first to last; default: a film all, a picture the last");
  command->add_flag("--sheet", arguments->sheet, "All frames in one picture; default: 12 of them");
  command->add_flag("--quiet", arguments->quiet, "No progress");
  add_setting_options(*command, *arguments);
  command->footer(
      "Examples:\n"
      "  pliant render curtain_wind --out curtain.mp4\n"
      "  pliant render torus --out torus.png --frames 9 --sheet\n"
      "  pliant render out/flag --out flag.webm --colour stretch --size 1920x1080");
  command->callback([arguments, &exit_code] { exit_code = render(*arguments); });
}

}  // namespace pliant_cli
