#include "pliant_io/scene/detail/read_factors.h"

#include "pliant_io/scene/detail/json_values.h"
#include "pliant_io/scene/detail/read_map.h"
#include "pliant_io/scene/nearest_names.h"

namespace pliant {
namespace {

/// Groups of a body alone.
std::vector<std::string_view> own_groups(const Simulation& simulation, BodyId body) {
  std::vector<std::string_view> names;
  for (const auto& [id, group] : simulation.groups()) {
    if (group.body == body && !group.other && group.source != nullptr) names.push_back(group.name);
  }
  return names;
}

std::vector<Real> read_factors(const Node& node, const Mesh& mesh) {
  if (node.is_object()) return read_mapped_values(node, mesh);
  std::vector<Real> factors;
  node.require_list(static_cast<std::size_t>(mesh.vertex_count()), "(one a vertex), or an object with a map");
  read(node, factors);
  return factors;
}

}  // namespace

void read_stiffness_factors(const Node& node, BodyId body, std::map<std::string, DisabledPart>& disabled,
                            Simulation& simulation) {
  node.require_object();
  const std::vector<std::string_view> known = own_groups(simulation, body);
  for (const std::string_view name : node.keys()) {
    const Node value = node.require(name);
    const auto off = disabled.find(std::string(name));
    if (off != disabled.end() && off->second.body == body) {
      off->second.factors = read_factors(value, simulation.body(body).mesh);
      value.locate([&] { check_stiffness_factors(off->second.factors, printable(name)); });
      continue;
    }
    const std::optional<GroupId> group = simulation.find_group(name);
    if (!group || std::ranges::find(known, name) == known.end()) {
      value.fail(fmt::format("'{}' is no group of the body '{}' that takes factors; {}", printable(name),
                             printable(simulation.body(body).name), suggestion_text(name, known)));
    }
    std::vector<Real> factors = read_factors(value, simulation.body(body).mesh);
    value.locate([&] { simulation.set_stiffness_factors(*group, std::move(factors)); });
  }
}

}  // namespace pliant
