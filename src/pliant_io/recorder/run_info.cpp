#include "pliant_io/recorder/run_info.h"

#include <map>

#include <nlohmann/json.hpp>

#include "pliant/core/version.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/files/crc32.h"
#include "pliant_io/recorder/run_files.h"

namespace pliant {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// A visitor that writes each option under its name, enumerations by their names.
struct OptionWriter {
  OrderedJson& json;

  template <class Option>
  void operator()(const OptionInfo& info, const Option& option) const {
    if constexpr (std::is_enum_v<Option>) {
      json[std::string(info.name)] = choice_names(option)[static_cast<std::size_t>(option)];
    } else if constexpr (std::is_same_v<Option, Index>) {
      const bool is_word = !info.word.empty() && option == info.number_of_word;
      json[std::string(info.name)] = is_word ? OrderedJson(info.word) : OrderedJson(option);
    } else {
      json[std::string(info.name)] = option;
    }
  }
};

OrderedJson describe_settings(const SolverSettings& settings) {
  OrderedJson json = OrderedJson::object();
  SolverSettings::visit(settings, OptionWriter{json});
  return json;
}

OrderedJson describe_bodies(const Simulation& simulation) {
  OrderedJson bodies = OrderedJson::array();
  for (const Body& body : simulation.bodies()) {
    bodies.push_back({{"name", body.name},
                      {"first_vertex", body.first_vertex},
                      {"vertices", body.mesh.vertex_count()},
                      {"edges", body.mesh.edges.size()},
                      {"triangles", body.mesh.triangles.size()},
                      {"tetrahedra", body.mesh.tetrahedra.size()}});
  }
  return bodies;
}

OrderedJson describe_groups(const Simulation& simulation) {
  OrderedJson groups = OrderedJson::array();
  for (const auto& [id, group] : simulation.groups()) {
    OrderedJson& json = groups.emplace_back(OrderedJson::object());
    describe_group(simulation, group, [&](const char* key, const auto& value) { json[key] = value; });
  }
  return groups;
}

}  // namespace

std::map<std::string, std::int64_t> count_constraints(const Simulation& simulation) {
  std::map<std::string, std::int64_t> counts;
  for (const auto& [id, group] : simulation.groups()) counts[group.type] += group.set.count;
  return counts;
}

std::uint32_t frame_checksum(const Positions& positions) {
  const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> rounded = positions.cast<float>();
  const auto size = static_cast<std::size_t>(rounded.size()) * sizeof(float);
  return crc32({reinterpret_cast<const char*>(rounded.data()), size});  // NOLINT: bytes of numbers
}

void write_run_info(const std::filesystem::path& path, const RunInfo& info, const Simulation& simulation) {
  OrderedJson json;
  json["scene"] = info.scene;
  json["source"] = info.source;
  json["outcome"] = choice_names(info.outcome)[static_cast<std::size_t>(info.outcome)];
  if (!info.error.empty()) json["error"] = info.error;
  json["steps"] = info.wanted_steps;
  if (info.resumed_from) json["resumed_from"] = *info.resumed_from;
  json["settings"] = describe_settings(simulation.settings());
  json["output"] = {{"format", info.frame_format}, {"every", info.every}, {"files", run_files(info.frame_format)}};
  json["used"] = {{"pliant", version},
                  {"compiler", compiler},
                  {"backend", simulation.backend()},
                  {"precision", choice_names(simulation.precision())[static_cast<std::size_t>(simulation.precision())]},
                  {"contraction", simulation.contraction()},
                  {"threads", simulation.thread_count()}};
  json["counts"] = {{"vertices", simulation.state().vertex_count()}, {"constraints", count_constraints(simulation)}};
  json["bodies"] = describe_bodies(simulation);
  json["groups"] = describe_groups(simulation);
  OrderedJson forces = OrderedJson::array();
  for (const auto& [id, force] : simulation.forces()) forces.push_back(force->type());
  json["forces"] = std::move(forces);
  OrderedJson colliders = OrderedJson::array();
  for (const auto& [id, collider] : simulation.colliders()) {
    colliders.push_back({{"name", collider.name}, {"type", collider.shape->type()}});
  }
  json["colliders"] = std::move(colliders);
  json["warnings"] = simulation.warnings();
  json["totals"] = {{"steps", simulation.state().step},
                    {"time", simulation.state().time},
                    {"frames", info.frames},
                    {"wall_seconds", info.wall_seconds}};
  if (info.last_frame) json["totals"]["last_frame_crc32"] = *info.last_frame;
  json["missed_tolerance"] = {{"steps", info.missed_tolerance.steps},
                              {"worst_residual", info.missed_tolerance.worst_residual}};
  if (info.worst_step) {
    json["worst_step"] = {{"step", info.worst_step->step},
                          {"body", info.worst_step->body},
                          {"distance", info.worst_step->distance},
                          {"share", info.worst_step->share}};
  }
  // Names may hold bytes that are not UTF-8, such as a path's; they must not cost the file.
  write_file_atomically(path, json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + '\n');
}

}  // namespace pliant
