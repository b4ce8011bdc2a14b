#include <algorithm>
#include <cmath>
#include <cstring>

#include "pliant/core/printable.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/checkpoint/detail/checkpoint_file.h"
#include "pliant_io/checkpoint/detail/checkpoint_values.h"
#include "pliant_io/files/crc32.h"
#include "pliant_io/files/read_file.h"
#include "pliant_io/scene/detail/json_values.h"
#include "pliant_io/scene/detail/resolve_scene.h"
#include "pliant_io/scene/detail/scene_files.h"

namespace pliant {

namespace fs = std::filesystem;

namespace {

std::string read_bytes(const Node& node) {
  if (!node.is_bytes()) node.fail_type("a string of bytes");
  return std::string(node.bytes());
}

/// Numbers written as bytes, into all of `numbers`.
void read_numbers(const Node& node, std::span<Real> numbers) {
  if (!node.is_bytes() || node.bytes().size() != numbers.size_bytes()) {
    node.fail(fmt::format("the list has another length than the scene of this checkpoint makes; {} numbers belong here",
                          numbers.size()));
  }
  if (!numbers.empty()) std::memcpy(numbers.data(), node.bytes().data(), numbers.size_bytes());
  if (std::ranges::all_of(numbers, [](Real x) { return std::isfinite(x); })) return;
  node.fail("a number is not finite; take another checkpoint");
}

Real read_real(const Node& node) {
  Real number = 0;
  read(node, number);
  return number;
}

template <class Visitor>
void for_each(const Node& list, Visitor&& visitor) {
  list.require_list();
  for (std::size_t i = 0; i < list.size(); ++i) visitor(list[i]);
}

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

void read_rotation(const Node& node, Quaternion& rotation) {
  read_numbers(node, {rotation.coeffs().data(), 4});
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

void restore_groups(const Node& list, const Simulation& simulation) {
  list.require_list(simulation.groups().size(), "(one a group)");
  std::size_t i = 0;
  for (const auto& [id, group] : simulation.groups()) {
    const Node node = list[i++];
    if (read_bytes(node.require("name")) != group.name) {
      node.fail(fmt::format("the scene has the group '{}' here; take another checkpoint", printable(group.name)));
    }
    const Node batches = node.require("batches");
    batches.require_list(group.set.batches.size(), "(one a batch)");
    for (std::size_t p = 0; p < group.set.batches.size(); ++p) {
      ConstraintGroup& batch = *group.set.batches[p];
      read_numbers(batches[p].require("parameters"), batch.parameters());
      const Node stiffness = batches[p].require("stiffness");
      stiffness.locate([&] { batch.set_stiffness(read_real(stiffness)); });
    }
  }
}

void read_rows(const Node& node, Positions& positions, Positions& velocities) {
  for (const auto& [key, rows] : {std::pair{"positions", &positions}, {"velocities", &velocities}}) {
    read_numbers(node.require(key), {rows->data(), static_cast<std::size_t>(rows->size())});
  }
}

Pose read_pose(const Node& node) {
  Pose pose;
  read_numbers(node.require("position"), {pose.position.data(), 3});
  read_rotation(node.require("rotation"), pose.rotation);
  return pose;
}

/// What friction remembers, of so many contacts as the list of vertices has.
std::vector<ContactMemory> read_memory(const Node& node) {
  const Node vertices = node.require("vertices");
  const Node touched = node.require("touched");
  vertices.require_list();
  touched.require_list(vertices.size(), "(one a contact)");
  std::vector<Real> numbers(4 * vertices.size());
  read_numbers(node.require("anchors_and_loads"), numbers);
  std::vector<ContactMemory> memory(vertices.size());
  for (std::size_t i = 0; i < memory.size(); ++i) {
    read(vertices[i], memory[i].vertex);
    read(touched[i], memory[i].collider);
    memory[i].anchor = {numbers[4 * i], numbers[4 * i + 1], numbers[4 * i + 2]};
    memory[i].load = numbers[4 * i + 3];
  }
  return memory;
}

/// What friction remembers of pairs of surfaces.
std::vector<PairMemory> read_pairs(const Node& node) {
  const Node features = node.require("pairs");
  features.require_list();
  if (features.size() % 3 != 0) features.fail("has no three numbers for each pair; take another checkpoint");
  std::vector<PairMemory> pairs(features.size() / 3);
  std::vector<Real> slides(features.size());
  read_numbers(node.require("slides"), slides);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    Index kind = 0;
    read(features[3 * i], kind);
    if (kind < 0 || kind > static_cast<Index>(PairKind::vertex_edge)) {
      features.fail(fmt::format("has the kind {}; take another checkpoint", kind));
    }
    pairs[i].kind = static_cast<PairKind>(kind);
    read(features[3 * i + 1], pairs[i].features[0]);
    read(features[3 * i + 2], pairs[i].features[1]);
    pairs[i].slide = {slides[3 * i], slides[3 * i + 1], slides[3 * i + 2]};
  }
  return pairs;
}

/// A list of so many numbers for each thing; calls visit(numbers) with those of one.
template <std::size_t count, class Visit>
void for_each_of(const Node& list, Visit&& visit) {
  list.require_list();
  if (list.size() % count != 0) list.fail(fmt::format("has no {} numbers for each; take another checkpoint", count));
  for (std::size_t i = 0; i < list.size(); i += count) {
    std::array<Index, count> numbers{};
    for (std::size_t j = 0; j < count; ++j) read(list[i + j], numbers[j]);
    visit(numbers);
  }
}

LetGoState read_let_go(const Node& node) {
  LetGoState let_go;
  read(node.require("is_known"), let_go.is_known);
  for_each_of<3>(node.require("pairs"), [&](const auto& numbers) {
    let_go.pairs.push_back({{numbers[0], numbers[1]}, numbers[2] != 0});
  });
  for_each_of<2>(node.require("reduced"), [&](const auto& numbers) {
    let_go.reduced.push_back({numbers[0], numbers[1], 0});
  });
  std::vector<Real> shares(let_go.reduced.size());
  read_numbers(node.require("shares"), shares);
  for (std::size_t i = 0; i < shares.size(); ++i) let_go.reduced[i].share = shares[i];
  for_each_of<2>(node.require("held_up"), [&](const auto& numbers) {
    let_go.held_up.push_back({numbers[0], numbers[1]});
  });
  return let_go;
}

/// Whether colliders and contacts are those of the simulation, Simulation::restore() says.
ContactState read_contact(const Node& node, const State& fresh) {
  constexpr Index most_light_steps = 1000;
  ContactState contact;
  for_each(node.require("colliders"), [&](const Node& entry) {
    ColliderState& collider = contact.colliders.emplace_back();
    read(entry.require("collider"), collider.collider);
    collider.pose = read_pose(entry.require("pose"));
    if (const auto target = entry.find("target")) collider.target = read_pose(*target);
  });
  contact.memory = read_memory(node);
  contact.pairs = read_pairs(node);
  if (const auto let_go = node.find("let_go")) contact.let_go = read_let_go(*let_go);
  const auto read_of_vertices = [&](const Node& entry, std::vector<Real>& numbers) {
    if (!entry.is_bytes() || !entry.bytes().empty()) numbers.resize(fresh.masses.size());
    read_numbers(entry, numbers);
  };
  read_of_vertices(node.require("stiffening"), contact.stiffening);
  read_of_vertices(node.require("in_factor"), contact.in_factor);
  if (const auto energies = node.find("energies")) read_of_vertices(*energies, contact.energies);
  read(node.require("light_steps"), contact.light_steps);
  if (contact.light_steps < 0 || contact.light_steps > most_light_steps) {
    node.require("light_steps").fail(fmt::format("{} is out of range; take another checkpoint", contact.light_steps));
  }
  return contact;
}

State read_state(const Node& node, const State& fresh) {
  State state = fresh;
  read(node.require("step"), state.step);
  if (state.step < 0 || state.step > max_steps) {
    node.require("step").fail(fmt::format("{} is out of range; take another checkpoint", state.step));
  }
  state.time = read_real(node.require("time"));
  state.time_excess = read_real(node.require("time_excess"));
  read_rows(node, state.positions, state.velocities);
  if (const auto previous = node.find("previous")) {
    state.previous_time_step = read_real(previous->require("time_step"));
    for (Positions* rows : {&state.previous_positions, &state.previous_velocities}) rows->resizeLike(state.positions);
    read_rows(*previous, state.previous_positions, state.previous_velocities);
  }
  if (const auto iterations = node.find("iterations")) {
    read(*iterations, state.iterations);
    if (state.iterations < 1) iterations->fail("not 1 or more; take another checkpoint");
  }
  if (const auto contact = node.find("contact")) state.contact = read_contact(*contact, fresh);
  if (const auto surplus = node.find("energy_surplus")) {
    state.energy_surplus.resize(state.masses.size());
    read_numbers(*surplus, state.energy_surplus);
  }
  return state;
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

/// `folder` is where the checkpoint is; empty: not known.
Scene restore_scene(std::string_view bytes, std::string_view name, const fs::path& folder,
                    const ResumeOptions& options) {
  const Origin origin{std::string(name)};
  const Unsealed unsealed = unseal(bytes, name);
  const Document document(parse_cbor(unsealed.content, name), {&origin});
  const Node root(document);
  SceneSource source = read_source(root.require("source"));
  if (options.steps) source.overrides.steps = options.steps;
  if (options.threads) source.overrides.threads = options.threads;
  const Node files = root.require("files");
  const RunMove move = read_move(root, folder);
  const bool has_moved = check_files(files, move);
  if (has_moved) move_folders(source, move);
  Scene scene = root.require("source").locate([&] {
    if (unsealed.has_old_contact) keep_old_contact(source);
    return parse_scene(std::move(source));
  });
  if (has_moved) check_files_read(files, scene);

  Simulation& simulation = scene.simulation;
  const Node timeline = root.require("timeline");
  const TimelineState timeline_state = read_timeline(timeline);
  timeline.locate([&] { scene.timeline.replay(simulation, timeline_state); });
  restore_groups(root.require("groups"), simulation);
  const Node node = root.require("state");
  const State state = read_state(node, simulation.state());
  node.locate([&] { simulation.restore(state); });
  if (scene.steps < simulation.state().step) {
    fail_input(fmt::format("{}: {} steps in all were asked for, but {} have been taken; ask for more", name,
                           scene.steps, simulation.state().step));
  }
  return scene;
}

}  // namespace

Scene parse_checkpoint(std::string_view bytes, std::string_view name, const ResumeOptions& options) {
  return restore_scene(bytes, name, {}, options);
}

Scene read_checkpoint(const fs::path& path, const ResumeOptions& options) {
  return restore_scene(read_file(path), path.string(), absolute_path(path).parent_path(), options);
}

}  // namespace pliant
