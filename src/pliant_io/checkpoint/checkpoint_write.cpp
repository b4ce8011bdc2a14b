#include <cstring>

#include <nlohmann/json.hpp>

#include "pliant/core/version.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/checkpoint/detail/checkpoint_file.h"
#include "pliant_io/checkpoint/detail/checkpoint_values.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/scene/detail/scene_files.h"

namespace pliant {
namespace {

using Json = nlohmann::json;

Json bytes_of(const void* data, std::size_t size) {
  const auto* begin = static_cast<const std::uint8_t*>(data);
  return Json::binary(std::vector<std::uint8_t>(begin, begin + size));
}

/// Texts may hold what is no UTF-8, a path for one; bytes may hold anything.
Json bytes_of(std::string_view text) {
  return bytes_of(text.data(), text.size());
}

Json bytes_of(std::span<const Real> numbers) {
  return bytes_of(numbers.data(), numbers.size_bytes());
}

Json bytes_of(const Positions& rows) {
  return bytes_of(std::span<const Real>(rows.data(), static_cast<std::size_t>(rows.size())));
}

Json bytes_of(const Vec3& vector) {
  return bytes_of(std::span<const Real>(vector.data(), 3));
}

/// Paths that hold in whatever folder the run is taken up.
Json absolute_bytes(const std::filesystem::path& path) {
  return bytes_of(absolute_path(path).string());
}

Json write_source(const SceneSource& source) {
  Json texts = Json::array();
  for (const SceneText& text : source.texts) {
    texts.push_back({{"name", bytes_of(text.name)},
                     {"folder", absolute_bytes(text.folder)},
                     {"file", bytes_of(text.file.string())},
                     {"text", bytes_of(text.text)}});
  }
  Json overrides = Json::object();
  visit_overrides(source.overrides, [&](const char* name, const auto& value) {
    if (!value) return;
    if constexpr (std::is_enum_v<std::remove_cvref_t<decltype(*value)>>) {
      overrides[name] = choice_names(*value)[static_cast<std::size_t>(*value)];
    } else {
      overrides[name] = *value;
    }
  });
  Json set = Json::array();
  for (const std::string& one : source.overrides.set) set.push_back(bytes_of(one));
  return {{"texts", std::move(texts)},
          {"overrides", std::move(overrides)},
          {"set", std::move(set)},
          {"set_folder", absolute_bytes(source.overrides_folder)}};
}

Json write_files(const std::vector<SceneFile>& files) {
  Json list = Json::array();
  for (const SceneFile& file : files) {
    list.push_back({{"path", absolute_bytes(file.path)}, {"size", file.size}, {"crc32", file.crc32}});
  }
  return list;
}

Json write_pose(const Pose& pose) {
  return {{"position", bytes_of(pose.position)},
          {"rotation", bytes_of(std::span<const Real>(pose.rotation.coeffs().data(), 4))}};
}

Json write_let_go(const LetGoState& let_go) {
  std::vector<Index> pairs;  // of each two vertices, and whether one was held up
  for (const LetGoVertices& each : let_go.pairs) {
    pairs.insert(pairs.end(), {each.vertices[0], each.vertices[1], each.is_held_up ? 1 : 0});
  }
  std::vector<Index> reduced;  // of each a vertex and a body
  std::vector<Real> shares;
  for (const ReducedDistance& each : let_go.reduced) {
    reduced.insert(reduced.end(), {each.vertex, each.body});
    shares.push_back(each.share);
  }
  std::vector<Index> held_up;  // of each a vertex and for how many substeps
  for (const HeldUpVertex& each : let_go.held_up) held_up.insert(held_up.end(), {each.vertex, each.substeps});
  return {{"is_known", let_go.is_known},
          {"pairs", std::move(pairs)},
          {"reduced", std::move(reduced)},
          {"shares", bytes_of(shares)},
          {"held_up", std::move(held_up)}};
}

Json write_contact(const ContactState& contact) {
  Json colliders = Json::array();
  for (const ColliderState& each : contact.colliders) {
    Json& json = colliders.emplace_back(Json{{"collider", each.collider}, {"pose", write_pose(each.pose)}});
    if (each.target) json["target"] = write_pose(*each.target);
  }
  std::vector<Index> vertices;
  std::vector<Index> touched;
  std::vector<Real> numbers;  // of each contact the anchor and the load
  for (const ContactMemory& each : contact.memory) {
    vertices.push_back(each.vertex);
    touched.push_back(each.collider);
    numbers.insert(numbers.end(), {each.anchor.x(), each.anchor.y(), each.anchor.z(), each.load});
  }
  std::vector<Index> features;  // of each pair of surfaces the kind and two numbers
  std::vector<Real> slides;
  for (const PairMemory& each : contact.pairs) {
    features.insert(features.end(), {static_cast<Index>(each.kind), each.features[0], each.features[1]});
    slides.insert(slides.end(), each.slide.begin(), each.slide.end());
  }
  return {{"colliders", std::move(colliders)},
          {"pairs", std::move(features)},
          {"slides", bytes_of(slides)},
          {"let_go", write_let_go(contact.let_go)},
          {"vertices", std::move(vertices)},
          {"touched", std::move(touched)},
          {"anchors_and_loads", bytes_of(numbers)},
          {"stiffening", bytes_of(contact.stiffening)},
          {"in_factor", bytes_of(contact.in_factor)},
          {"energies", bytes_of(contact.energies)},
          {"light_steps", contact.light_steps}};
}

Json write_state(const State& state) {
  Json json = {{"step", state.step},
               {"time", state.time},
               {"time_excess", state.time_excess},
               {"positions", bytes_of(state.positions)},
               {"velocities", bytes_of(state.velocities)}};
  if (state.previous_time_step > 0) {
    json["previous"] = {{"time_step", state.previous_time_step},
                        {"positions", bytes_of(state.previous_positions)},
                        {"velocities", bytes_of(state.previous_velocities)}};
  }
  if (state.iterations > 0) json["iterations"] = state.iterations;
  if (!state.contact.is_empty()) json["contact"] = write_contact(state.contact);
  if (!state.energy_surplus.empty()) json["energy_surplus"] = bytes_of(state.energy_surplus);
  return json;
}

Json write_groups(const Simulation& simulation) {
  Json groups = Json::array();
  for (const auto& [id, group] : simulation.groups()) {
    Json batches = Json::array();
    for (const auto& batch : group.set.batches) {
      batches.push_back({{"stiffness", batch->stiffness()}, {"parameters", bytes_of(batch->parameters())}});
    }
    groups.push_back({{"name", bytes_of(group.name)}, {"batches", std::move(batches)}});
  }
  return groups;
}

Json write_motion(const TimelineState::Motion& motion) {
  Json points = Json::array();
  for (const MotionPoint& point : motion.numbers.points) {
    points.push_back(
        {{"number", point.number}, {"place", point.place}, {"from", bytes_of(point.from)}, {"vertex", point.vertex}});
  }
  return {{"event", motion.event},
          {"order", motion.order},
          {"begin", motion.numbers.begin},
          {"center", bytes_of(motion.numbers.center)},
          {"points", std::move(points)}};
}

Json write_motion(const ColliderMotionNumbers& motion) {
  Json json = write_motion(TimelineState::Motion{motion.event, motion.order, motion.numbers});
  json["rotation"] = bytes_of(std::span<const Real>(motion.rotation.coeffs().data(), 4));
  return json;
}

Json write_timeline(const TimelineState& timeline) {
  Json motions = Json::array();
  for (const TimelineState::Motion& motion : timeline.motions) motions.push_back(write_motion(motion));
  Json collider_motions = Json::array();
  for (const ColliderMotionNumbers& motion : timeline.collider_motions) {
    collider_motions.push_back(write_motion(motion));
  }
  Json ramps = Json::array();
  for (const StiffnessRamp& ramp : timeline.ramps) {
    ramps.push_back({{"group", static_cast<Index>(ramp.group)},
                     {"from", ramp.from},
                     {"to", ramp.to},
                     {"begin", ramp.begin},
                     {"duration", ramp.duration},
                     {"ease", choice_names(ramp.ease)[static_cast<std::size_t>(ramp.ease)]}});
  }
  return {{"applied", timeline.applied},
          {"motions", std::move(motions)},
          {"collider_motions", std::move(collider_motions)},
          {"ramps", std::move(ramps)}};
}

}  // namespace

std::string checkpoint_bytes(const Scene& scene, const std::filesystem::path& folder) {
  const Json content = {{"pliant", version},
                        {"compiler", compiler},
                        {"folder", bytes_of(absolute_path(folder).string())},
                        {"source", write_source(scene.source)},
                        {"files", write_files(scene.files)},
                        {"state", write_state(scene.simulation.state())},
                        {"groups", write_groups(scene.simulation)},
                        {"timeline", write_timeline(scene.timeline.state())}};
  std::string bytes;
  Json::to_cbor(content, bytes);
  return seal(bytes);
}

void write_checkpoint(const std::filesystem::path& path, const Scene& scene) {
  write_file_atomically(path, checkpoint_bytes(scene, absolute_path(path).parent_path()));
}

}  // namespace pliant
