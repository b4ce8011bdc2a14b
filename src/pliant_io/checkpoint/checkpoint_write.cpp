#include <nlohmann/json.hpp>

#include "pliant/core/version.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/checkpoint/detail/checkpoint_file.h"
#include "pliant_io/checkpoint/detail/checkpoint_values.h"
#include "pliant_io/checkpoint/detail/write_state.h"
#include "pliant_io/checkpoint/detail/write_values.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/scene/detail/scene_files.h"

namespace pliant {

using Json = nlohmann::json;

namespace {

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
                        {"state", state_json(scene.simulation.state())},
                        {"groups", groups_json(scene.simulation)},
                        {"timeline", write_timeline(scene.timeline.state())}};
  std::string bytes;
  Json::to_cbor(content, bytes);
  return seal(bytes);
}

void write_checkpoint(const std::filesystem::path& path, const Scene& scene) {
  write_file_atomically(path, checkpoint_bytes(scene, absolute_path(path).parent_path()));
}

}  // namespace pliant
