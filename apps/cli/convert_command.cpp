// pliant convert: meshes to meshes; runs, recorded sessions and point caches to animations.
#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "choice_option.h"
#include "commands.h"
#include "number_option.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/export/animation_format.h"
#include "pliant_io/mesh/mesh_file.h"
#include "pliant_io/mesh/point_cache_format.h"
#include "pliant_io/recorder/run_files.h"
#include "render/run_replay.h"
#include "render/run_values.h"
#include "run_looks.h"
#include "scene_options.h"
#include "session_film.h"
#include "terminal.h"

namespace pliant_cli {
namespace {

namespace fs = std::filesystem;
using pliant::Animation;

struct ConvertOptions {
  fs::path in;                                    ///< a mesh, the folder of a run, a session or a point cache
  fs::path out;                                   ///< file whose extension says the format
  std::optional<fs::path> mesh;                   ///< of the vertices of a point cache
  pliant::ImportOptions import;                   ///< how a mesh is read: scale and axis
  pliant::PointCacheOptions cache;                ///< how a point cache is read
  std::optional<std::string> body;                ///< of a run, by its name; none: all
  std::optional<std::string> frames;              ///< "FIRST:LAST:STEP", both ends included; none: all
  std::optional<pliant::Real> time;               ///< of the one frame to take [s]
  std::optional<pliant::Real> frames_per_second;  ///< of the result [1/s]; none: as recorded
  pliant::ExportOptions exported;                 ///< how the result is written
  std::optional<std::int64_t> max_keyframes;      ///< of a glTF animation; none: 256
  bool yes = false;                               ///< thin frames without asking
};

/// FIRST, FIRST:LAST or FIRST:LAST:STEP; what is empty keeps its default.
pliant::FrameRange parse_frames(std::string_view text) {
  pliant::FrameRange range;
  const std::array numbers = {&range.first, &range.last, &range.step};
  const bool is_single = text.find(':') == text.npos;
  std::size_t part = 0;
  for (std::string_view rest = text;; ++part) {
    const std::string_view word = rest.substr(0, rest.find(':'));
    bool is_number = word.empty() && !is_single;
    if (part < numbers.size() && !is_number) {
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), *numbers[part]);
      is_number = error == std::errc() && end == word.data() + word.size();
    }
    if (part >= numbers.size() || !is_number) {
      pliant::fail_input(
          fmt::format("--frames: '{}' is not FIRST, FIRST:LAST or FIRST:LAST:STEP; give whole numbers, as "
                      "in 0:100:5",
                      text.substr(0, 40)));
    }
    if (word.size() == rest.size()) break;
    rest.remove_prefix(word.size() + 1);
  }
  if (is_single) range.last = range.first;
  return range;
}

bool is_sequence(const fs::path& out) {
  return out.filename().string().find('#') != std::string::npos;
}

/// Whether the output is that file, or may be in one of its frames.
bool may_replace(const fs::path& out, const fs::path& file) {
  std::error_code ignored;
  const auto format = pliant::animation_format(out);
  const fs::path place = fs::absolute(file, ignored).parent_path();
  if (format && format->folder != nullptr && fs::equivalent(place, format->folder(out), ignored)) return true;
  if (!is_sequence(out)) return fs::equivalent(file, out, ignored);
  const auto folder_of = [](const fs::path& path) { return path.has_parent_path() ? path.parent_path() : "."; };
  if (!fs::equivalent(folder_of(file), folder_of(out), ignored)) return false;
  const std::string pattern = out.filename().string();
  const std::string name = file.filename().string();
  const std::string_view head = std::string_view(pattern).substr(0, pattern.find('#'));
  const std::string_view tail = std::string_view(pattern).substr(pattern.find_last_of('#') + 1);
  return name.size() > head.size() + tail.size() && name.starts_with(head) && name.ends_with(tail);
}

void refuse_to_replace(const fs::path& out, const fs::path& input) {
  if (!may_replace(out, input)) return;
  pliant::fail_input(fmt::format("{}: this would replace the input; give another name for the output", input.string()));
}

/// The output must not take the place of anything it is made from.
void refuse_to_replace(const ConvertOptions& options) {
  std::vector<fs::path> inputs = {options.in};
  if (options.mesh) inputs.push_back(*options.mesh);
  std::error_code ignored;
  if (fs::is_directory(options.in, ignored)) {
    for (fs::directory_iterator entry(options.in, ignored), end; !ignored && entry != end; entry.increment(ignored)) {
      if (pliant::is_run_file(entry->path().filename().string())) inputs.push_back(entry->path());
    }
  }
  for (const fs::path& input : inputs) refuse_to_replace(options.out, input);
}

std::string writable_formats() {
  return fmt::format("meshes: {}; animations: {}", fmt::join(pliant::writable_mesh_extensions(), ", "),
                     pliant::animation_extensions());
}

/// The folder of a run, a point cache with or without its mesh, or a mesh that stands still.
Animation read_animation(const ConvertOptions& options) {
  std::error_code ignored;
  if (fs::is_directory(options.in, ignored)) {
    const bool is_placed = options.import.scale != 1 || options.import.up != pliant::UpAxis::z;
    if (options.mesh || is_placed) {
      pliant::fail_input(
          fmt::format("{}: a run has its own mesh, in meters and with z up; leave out --mesh, --scale "
                      "and --up",
                      options.in.string()));
    }
    return pliant::read_run(options.in);
  }
  const std::string name = options.mesh.value_or(options.in).stem().string();
  if (pliant::point_cache_format(options.in)) {
    pliant::PointCache cache = pliant::place(pliant::PointCache::read(options.in, options.cache), options.import);
    if (!options.mesh) return pliant::animate(name, std::move(cache));
    return pliant::animate(pliant::read_mesh(*options.mesh, options.import), name, std::move(cache));
  }
  if (options.mesh) {
    pliant::fail_input(fmt::format("{}: not a point cache; --mesh is for those: {}", options.in.string(),
                                   pliant::point_cache_extensions()));
  }
  if (!pliant::mesh_format(options.in)) {
    pliant::fail_input(fmt::format(
        "{}: neither the folder of a run nor a session (.session) nor a point cache ({}) nor a mesh (.{})",
        options.in.string(), pliant::point_cache_extensions(), fmt::join(pliant::readable_mesh_extensions(), ", .")));
  }
  return pliant::still(pliant::read_mesh(options.in, options.import), name);
}

/// Whether the output holds that beside bodies.
bool holds(const ConvertOptions& options, pliant::AnimationFormat::Beside beside) {
  const auto format = pliant::animation_format(options.out);
  return format && format->beside == beside;
}

struct Input {
  Animation animation;
  std::optional<pliant::Scene> session;  ///< the scene of a recorded one, as it was left
};

/// A session is done again, and has its colliders at hand.
Input read_input(const ConvertOptions& options) {
  if (!is_session(options.in)) return {read_animation(options), {}};
  if (options.mesh || options.import.scale != 1 || options.import.up != pliant::UpAxis::z) {
    pliant::fail_input(
        fmt::format("{}: a session has its own meshes, in meters and with z up; leave out --mesh, --scale and --up",
                    pliant::printable_place(options.in.string())));
  }
  SessionAnimation session = animation_of_session(options.in);
  if (options.body) session.animation.colliders.clear();
  if (holds(options, pliant::AnimationFormat::Beside::values)) {
    pliant_render::take_tetrahedra(session.animation, session.end.simulation);
  }
  return {std::move(session.animation), std::move(session.end)};
}

void select(Animation& animation, const ConvertOptions& options) {
  if (options.body) pliant::keep_body(animation, *options.body);
  if (options.frames) pliant::keep_frames(animation, parse_frames(*options.frames));
  if (options.time) pliant::keep_time(animation, *options.time);
  if (options.frames_per_second) pliant::resample(animation, *options.frames_per_second);
}

std::string rate_text(const Animation& animation) {
  const pliant::Real rate = pliant::frame_rate(animation.times);
  return rate > 0 ? fmt::format("{:.6g} frames per second", rate) : "frames not evenly spaced in time";
}

void print_animation(const fs::path& out, const Animation& animation, const pliant::ExportReport& report) {
  fmt::print("{}: {} frames, {} vertices, {:.4g} s, {}", pliant::printable(out.string()), report.frames,
             animation.cache.vertex_count(), animation.times.back() - animation.times.front(), rate_text(animation));
  if (report.keyframes < report.frames) {
    fmt::print("; {} of them kept, the others off by at most {:.2g} of the body's size", report.keyframes,
               report.largest_error);
  }
  fmt::print("\n");
}

void warn_of_tolerance(const pliant::ExportOptions& options, const pliant::ExportReport& report) {
  const pliant::Real wanted = options.tolerance.value_or(pliant::default_gltf_tolerance);
  if (report.largest_error <= wanted) return;
  print_to_stderr(
      fmt::format("warning: the error {:.2g} is past the tolerance {:.2g}, since at most {} keyframes are "
                  "kept; raise --max-keyframes to reduce it\n",
                  report.largest_error, wanted, options.max_keyframes));
}

/// Whether the output holds colliders, and the input is of a scene that may have some.
bool has_nodes(const ConvertOptions& options) {
  std::error_code ignored;
  return holds(options, pliant::AnimationFormat::Beside::colliders) && !options.body &&
         fs::is_directory(options.in, ignored);
}

/// The scene of a run, where it is known; its tetrahedra go to the bodies of the run.
std::optional<pliant::Scene> scene_of_run(const fs::path& folder, Animation& animation) {
  const fs::path checkpoint = folder / pliant::checkpoint_name;
  std::error_code ignored;
  if (!fs::exists(checkpoint, ignored)) return {};
  try {
    pliant::Scene scene = pliant::parse_scene(pliant::read_checkpoint(checkpoint).source);
    pliant_render::take_tetrahedra(animation, scene.simulation);
    return scene;
  } catch (const pliant::Error& error) {
    if (error.kind() != pliant::ErrorKind::input) throw;
    print_to_stderr("warning: the scene is not known, so neither tetrahedra nor energies are written: " +
                    pliant::printable_place(error.what(), message_limit) + "\n");
    return {};
  }
}

/// Those of the scene of a run, where it is known.
std::vector<pliant::AnimatedCollider> colliders_of_run(const fs::path& folder, const pliant::PointCache& frames) {
  const fs::path checkpoint = folder / pliant::checkpoint_name;
  std::error_code ignored;
  if (!fs::exists(checkpoint, ignored)) return {};
  try {
    pliant::SceneSource source = pliant::read_checkpoint(checkpoint).source;
    if (!mentions(source, "collider")) return {};  // it is not made again, which may take long
    return pliant_render::recorded_colliders(pliant::parse_scene(std::move(source)), frames);
  } catch (const pliant::Error& error) {
    if (error.kind() != pliant::ErrorKind::input) throw;
    print_to_stderr("warning: the colliders of the scene are not known, so none is written: " +
                    pliant::printable_place(error.what(), message_limit) + "\n");
    return {};
  }
}

/// That frames are left out is for the user to say: by an option, or when asked.
void agree_to_thin(const fs::path& out, const pliant::ExportReport& report) {
  const std::string what =
      fmt::format("{}: {} of {} frames would be kept, the others off by at most {:.2g} of the body's size",
                  pliant::printable_place(out.string()), report.keyframes, report.frames, report.largest_error);
  const std::optional<bool> answer = ask(what + "; write it?");
  if (answer == true) return;
  pliant::fail_input(
      fmt::format("{}; agree with --yes, or choose --tolerance or --max-keyframes ('--tolerance 0 --max-keyframes {}' "
                  "keeps all)",
                  answer ? "nothing was written" : what, std::max<std::int64_t>(2, report.frames)));
}

/// What the export needs to know beside its options. Bodies get the texture coordinates of what they look like.
pliant::ExportOptions complete_options(const ConvertOptions& options, Animation& animation,
                                       const std::optional<pliant::Scene>& session) {
  pliant::ExportOptions exported = options.exported;
  exported.max_keyframes = options.max_keyframes.value_or(exported.max_keyframes);
  std::error_code ignored;
  if (holds(options, pliant::AnimationFormat::Beside::colliders) &&
      (session || fs::is_directory(options.in, ignored))) {
    RunLooks looks = session ? looks_of_scene(*session, animation) : looks_of_run(options.in, animation);
    for (const fs::path& texture : looks.textures) refuse_to_replace(options.out, texture);
    exported.looks = std::move(looks.of_bodies);
    exported.collider_looks = std::move(looks.of_colliders);
  }
  const auto format = pliant::animation_format(options.out);
  if (!format || format->thins != pliant::AnimationFormat::Thins::always) return exported;
  if (!options.yes && !options.exported.tolerance && !options.max_keyframes) {
    exported.before_thinning = [&options](const pliant::ExportReport& report) { agree_to_thin(options.out, report); };
  }
  return exported;
}

void convert(const ConvertOptions& options) {
  const bool is_mesh = pliant::mesh_format(options.out).has_value();
  if (!is_mesh && !pliant::animation_format(options.out)) {
    pliant::fail_input(fmt::format("{}: its extension is of no format that can be written; {}", options.out.string(),
                                   writable_formats()));
  }
  refuse_to_replace(options);
  Input input = read_input(options);
  Animation& animation = input.animation;
  if (has_nodes(options)) animation.colliders = colliders_of_run(options.in, animation.cache);
  std::optional<pliant::Scene> scene;
  if (holds(options, pliant::AnimationFormat::Beside::values) && !input.session)
    scene = scene_of_run(options.in, animation);
  select(animation, options);
  if (!is_mesh) {
    pliant::ExportOptions exported = complete_options(options, animation, input.session);
    std::optional<pliant_render::RunValues> values;
    if (holds(options, pliant::AnimationFormat::Beside::values) && !animation.bodies.empty()) {
      values.emplace(animation, std::move(scene));
      exported.values = [&values](std::size_t frame) { return values->at(frame); };
    }
    const pliant::ExportReport report = pliant::export_animation(options.out, animation, exported);
    print_animation(options.out, animation, report);
    warn_of_tolerance(exported, report);
  } else if (is_sequence(options.out)) {
    const std::int64_t count = pliant::export_sequence(options.out, animation);
    fmt::print("{}: {} files, {} vertices each, {}\n", pliant::printable(options.out.string()), count,
               animation.cache.vertex_count(), rate_text(animation));
  } else {
    pliant::export_frame(options.out, animation);
    fmt::print("{}: {} vertices, at {:.4g} s\n", pliant::printable(options.out.string()),
               animation.cache.vertex_count(), animation.times.front());
  }
}

constexpr const char* convert_footer = R"(A name OUT with #### gets one mesh file a frame, with its number there.
Examples:
  pliant convert out/flag flag.glb                       an animation for browsers and game engines
  pliant convert out/flag flag.usda                      for Blender, Houdini, Maya
  pliant convert out/flag flag.pvd                       for ParaView, with velocity, stretch and energy
  pliant convert out/flag flag.pc2 --fps 24              a point cache for the mesh in out/flag/mesh.obj
  pliant convert out/flag frames/flag_####.ply           one file a frame
  pliant convert out/flag flag.obj --time 2.5            a single moment
  pliant convert curtain_wind-1.session pulled.glb       what was done in the window
  pliant convert walk.mdd walk.glb --mesh walk.obj       a point cache and its mesh
  pliant convert part.stl part.obj --scale 0.001 --up y  a mesh in millimeters with y up)";

}  // namespace

void add_convert_command(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("convert", "Convert meshes; export runs, sessions and point caches as animations");
  const auto options = std::make_shared<ConvertOptions>();
  command
      ->add_option("in", options->in,
                   "A mesh, the folder of a run, a recorded session (.session) or a point cache (pc2, mdd, npy)")
      ->type_name("FILE")
      ->required();
  command->add_option("out", options->out, "The file to write")->type_name("FILE")->required();
  command->add_option("--mesh", options->mesh, "The mesh that the point cache IN moves")->type_name("FILE");
  add_number(*command, "--scale", options->import.scale, "Meters per unit of a mesh or point cache IN");
  add_choice(*command, "--up", options->import.up, "Its axis that points up: z (default), y or x");
  add_number(*command, "--in-fps", options->cache.frames_per_second,
             "Frames per second of a point cache without times (pc2, npy), default 24");
  command->add_option("--body", options->body, "Take one body of the run");
  command->add_option("--frames", options->frames,
                      "Take frames FIRST:LAST:STEP, both ends included; -1 is the last, as in --frames=-1");
  add_number(*command, "--time", options->time, "Take the moment at this time [s]");
  add_number(*command, "--fps", options->frames_per_second, "Frames per second of OUT; default: those of IN");
  add_number(*command, "--tolerance", options->exported.tolerance,
             "glb, gltf (default 0.001), usda: leave out frames that linear interpolation meets within this, in "
             "sizes of the body");
  add_number(*command, "--max-keyframes", options->max_keyframes, "glb, gltf: keep at most these, default 256");
  command->add_flag("--yes", options->yes,
                    "glb, gltf: leave out frames without asking; so do --tolerance and --max-keyframes");
  add_choice(*command, "--normals", options->exported.normals, "glb, gltf: smooth (default) or flat");
  command->footer(fmt::format("Formats of OUT, by its extension; {}.\n{}", writable_formats(), convert_footer));
  command->callback([options] { convert(*options); });
}

}  // namespace pliant_cli
