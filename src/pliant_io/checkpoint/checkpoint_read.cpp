#include "pliant/core/printable.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/checkpoint/detail/checkpoint_file.h"
#include "pliant_io/checkpoint/detail/checkpoint_values.h"
#include "pliant_io/checkpoint/detail/read_state.h"
#include "pliant_io/checkpoint/detail/read_values.h"
#include "pliant_io/files/crc32.h"
#include "pliant_io/files/read_file.h"
#include "pliant_io/scene/detail/json_values.h"
#include "pliant_io/scene/detail/resolve_scene.h"
#include "pliant_io/scene/detail/scene_files.h"

namespace pliant {

namespace fs = std::filesystem;

namespace {

SceneSource read_source(const Node& node) {
  SceneSource source;
  source.is_complete = true;
  for_each(node.require("texts"), [&](const Node& text) {
    source.texts.push_back({read_bytes(text.require("name")), read_bytes(text.require("folder")),
                            read_bytes(text.require("text")), read_bytes(text.require("file"))});
  });
  const Node overrides = node.require("overrides");
  visit_overrides(source.overrides, [&](std::string_view name, auto& value) {
    if (const auto given = overrides.find(name)) read(*given, value.emplace());
  });
  for_each(node.require("set"), [&](const Node& one) { source.overrides.set.push_back(read_bytes(one)); });
  source.overrides_folder = read_bytes(node.require("set_folder"));
  return source;
}

/// Where a run was when it left the checkpoint, and where it is now; `now` is empty when that is not known.
struct RunMove {
  fs::path then;
  fs::path now;

  bool has_happened() const { return !then.empty() && !now.empty() && then != now; }
  /// The place of a file or folder that was moved together with the run.
  fs::path operator()(const fs::path& path) const {
    const fs::path relative = path.lexically_relative(then);
    return relative.empty() ? path : (now / relative).lexically_normal();
  }
};

RunMove read_move(const Node& root, const fs::path& now) {
  const auto folder = root.find("folder");
  return {folder ? fs::path(read_bytes(*folder)) : fs::path(), now.empty() ? now : absolute_path(now)};
}

/// A mesh, map or point cache as it was when the checkpoint was made.
struct FileStamp {
  fs::path path;
  std::uint64_t size = 0;
  std::uint32_t sum = 0;

  bool fits(std::string_view bytes) const { return bytes.size() == size && crc32(bytes) == sum; }
  bool is_at(const fs::path& place) const {
    try {
      return fits(read_file(place));
    } catch (const Error&) {  // none that can be read
      return false;
    }
  }
};

FileStamp read_stamp(const Node& node) {
  std::int64_t size = 0;
  std::int64_t sum = 0;
  read(node.require("size"), size);
  read(node.require("crc32"), sum);
  return {read_bytes(node.require("path")), static_cast<std::uint64_t>(size), static_cast<std::uint32_t>(sum)};
}

/// Refuses a mesh or a map that is another than it was. @returns whether any is where it was moved to with the run
bool check_files(const Node& list, const RunMove& move) {
  bool has_moved = false;
  for_each(list, [&](const Node& node) {
    const FileStamp stamp = read_stamp(node);
    if (stamp.is_at(stamp.path)) return;
    const fs::path there = move(stamp.path);
    if (move.has_happened() && stamp.is_at(there)) {
      has_moved = true;
      return;
    }
    std::error_code ignored;
    if (!fs::exists(stamp.path, ignored)) {
      const std::string other =
          fmt::format(", nor, since this run was moved, {} as it was; put the file in one of these places",
                      printable_place(there.string()));
      node.fail(fmt::format("{}: no such file{}, or run the scene from its start", printable_place(stamp.path.string()),
                            move.has_happened() ? other : "; put it back, or move the run together with its files"));
    }
    node.locate([&] { read_file(stamp.path); });  // what cannot be read says so
    node.fail(fmt::format(
        "{} is not as it was when this checkpoint was made; put that file back, or run the scene from its start",
        printable_place(stamp.path.string())));
  });
  return has_moved;
}

/// Has the relative paths of a scene start where its folders were moved to with the run.
void move_folders(SceneSource& source, const RunMove& move) {
  for (SceneText& text : source.texts) text.folder = move(text.folder);
  source.overrides_folder = move(source.overrides_folder);
}

/// A scene with relative and absolute paths may find some of its files in their new places and others in the old ones.
void check_files_read(const Node& list, const Scene& scene) {
  for (std::size_t i = 0; i < scene.files.size(); ++i) {
    const FileStamp stamp = i < list.size() ? read_stamp(list[i]) : FileStamp{};
    if (scene.files[i].size == stamp.size && scene.files[i].crc32 == stamp.sum) continue;
    list.fail(
        fmt::format("this run was moved, and {} is not as it was when this checkpoint was made; move all files of "
                    "the scene together with the run, or run the scene from its start",
                    printable_place(scene.files[i].path)));
  }
}

TimelineState::Motion read_motion(const Node& node) {
  TimelineState::Motion motion;
  read(node.require("event"), motion.event);
  read(node.require("order"), motion.order);
  motion.numbers.begin = read_real(node.require("begin"));
  read_numbers(node.require("center"), {motion.numbers.center.data(), 3});
  for_each(node.require("points"), [&](const Node& entry) {
    MotionPoint& point = motion.numbers.points.emplace_back();
    read(entry.require("number"), point.number);
    read(entry.require("place"), point.place);
    read(entry.require("vertex"), point.vertex);
    read_numbers(entry.require("from"), {point.from.data(), 3});
  });
  return motion;
}

TimelineState read_timeline(const Node& node) {
  TimelineState timeline;
  for_each(node.require("applied"), [&](const Node& event) { read(event, timeline.applied.emplace_back()); });
  for_each(node.require("motions"), [&](const Node& motion) { timeline.motions.push_back(read_motion(motion)); });
  for_each(node.require("collider_motions"), [&](const Node& entry) {
    TimelineState::Motion motion = read_motion(entry);
    ColliderMotionNumbers& of_collider = timeline.collider_motions.emplace_back();
    of_collider = {motion.event, motion.order, std::move(motion.numbers)};
    read_rotation(entry.require("rotation"), of_collider.rotation);
  });
  for_each(node.require("ramps"), [&](const Node& entry) {
    StiffnessRamp& ramp = timeline.ramps.emplace_back();
    Index group = 0;
    read(entry.require("group"), group);
    ramp.group = GroupId(group);
    ramp.from = read_real(entry.require("from"));
    ramp.to = read_real(entry.require("to"));
    ramp.begin = read_real(entry.require("begin"));
    ramp.duration = read_real(entry.require("duration"));
    read(entry.require("ease"), ramp.ease);
  });
  return timeline;
}

/// Where the scene's contact does not say whether surfaces touch, they did not in those days.
void keep_old_contact(SceneSource& source) {
  SceneFiles files;
  const ResolvedScene resolved = resolve_scene(source, files);
  const auto contact = Node(resolved.document).find("contact");
  if (contact && contact->is_object() && !contact->has("surfaces")) {
    source.overrides.set.emplace_back("contact.surfaces=false");
  }
}

/// The content of a checkpoint.
class Content {
 public:
  /// `folder` is where the checkpoint is; empty: not known.
  Content(std::string_view bytes, std::string_view name, const fs::path& folder)
      : origin_{std::string(name)},
        unsealed_(unseal(bytes, name)),
        document_(parse_cbor(unsealed_.content, name), {&origin_}),
        folder_(folder) {
    if (root().has("bodies")) {
      fail_input(
          fmt::format("{}: the state of a simulation without a scene; make the simulation as the program did, and "
                      "call `restore_state` on it",
                      printable_place(origin_.name)));
    }
  }

  Node root() const { return Node(document_); }

  /// The scene at its start.
  Scene open(const ResumeOptions& options) const {
    SceneSource source = read_source(root().require("source"));
    if (options.steps) source.overrides.steps = options.steps;
    if (options.threads) source.overrides.threads = options.threads;
    const Node files = root().require("files");
    const RunMove move = read_move(root(), folder_);
    const bool has_moved = check_files(files, move);
    if (has_moved) move_folders(source, move);
    Scene scene = root().require("source").locate([&] {
      if (unsealed_.has_old_contact) keep_old_contact(source);
      return parse_scene(std::move(source));
    });
    if (has_moved) check_files_read(files, scene);
    return scene;
  }

  /// Takes it to the moment of the checkpoint.
  void restore(Scene& scene) const {
    Simulation& simulation = scene.simulation;
    const Node timeline = root().require("timeline");
    const TimelineState timeline_state = read_timeline(timeline);
    timeline.locate([&] { scene.timeline.replay(simulation, timeline_state); });
    set_numbers(read_groups(root().require("groups"), simulation));
    const Node node = root().require("state");
    const State state = read_state(node, simulation.state());
    node.locate([&] { simulation.restore(state); });
    if (scene.steps < simulation.state().step) {
      fail_input(fmt::format("{}: {} steps in all were asked for, but {} have been taken; ask for more", origin_.name,
                             scene.steps, simulation.state().step));
    }
  }

 private:
  Origin origin_;
  Unsealed unsealed_;
  Document document_;
  fs::path folder_;
};

Scene resumed(const Content& content, const ResumeOptions& options) {
  Scene scene = content.open(options);
  content.restore(scene);
  return scene;
}

/// Calls use(content) of a checkpoint in a file.
template <class Use>
auto with_content(const fs::path& path, Use&& use) {
  const std::string bytes = read_file(path);
  return use(Content(bytes, path.string(), absolute_path(path).parent_path()));
}

}  // namespace

Scene parse_checkpoint(std::string_view bytes, std::string_view name, const ResumeOptions& options) {
  return resumed(Content(bytes, name, {}), options);
}

Scene read_checkpoint(const fs::path& path, const ResumeOptions& options) {
  return with_content(path, [&](const Content& content) { return resumed(content, options); });
}

Scene open_checkpoint(const fs::path& path, const ResumeOptions& options) {
  return with_content(path, [&](const Content& content) { return content.open(options); });
}

void restore_checkpoint(Scene& scene, const fs::path& path) {
  with_content(path, [&](const Content& content) { content.restore(scene); });
}

Scene open_checkpoint(std::string_view bytes, std::string_view name, const fs::path& folder,
                      const ResumeOptions& options) {
  return Content(bytes, name, folder.empty() ? folder : absolute_path(folder)).open(options);
}

void restore_checkpoint(Scene& scene, std::string_view bytes, std::string_view name) {
  Content(bytes, name, {}).restore(scene);
}

}  // namespace pliant
