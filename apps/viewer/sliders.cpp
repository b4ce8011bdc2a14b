#include "viewer/sliders.h"

#include <set>

#include <fmt/format.h>

namespace pliant_viewer {
namespace {

using pliant::GroupId;
using pliant::Parameter;

/// Gives "group:stretch", and with a number behind it where that was given before.
class UniqueNames {
 public:
  std::string next(std::string_view kind, std::string_view name) {
    std::string unique = fmt::format("{}:{}", kind, name);
    for (int number = 2; !taken_.insert(unique).second; ++number) unique = fmt::format("{}:{}:{}", kind, name, number);
    return unique;
  }

 private:
  std::set<std::string> taken_;
};

void add_sliders(const std::string& owner, std::vector<Parameter> parameters, std::vector<Slider>& list) {
  for (Parameter& each : parameters) {
    const bool is_named_alike = each.type == each.name;
    std::string heading = is_named_alike ? each.type : fmt::format("{} \"{}\"", each.type, each.name);
    list.push_back({owner + "." + each.handle.option, std::move(heading), std::move(each)});
  }
}

}  // namespace

std::vector<Slider> list_sliders(const pliant::Simulation& simulation, const std::function<bool(GroupId)>& is_hidden) {
  std::vector<Slider> list;
  UniqueNames names;
  add_sliders("settings", list_parameters(simulation, {}), list);
  for (const auto& [id, group] : simulation.groups()) {
    const std::string owner = names.next("group", group.name);
    if (is_hidden && is_hidden(id)) continue;
    const std::size_t first = list.size();
    add_sliders(owner, list_parameters(simulation, id), list);
    for (std::size_t i = first; i < list.size(); ++i) list[i].body = simulation.body(group.body).name;
  }
  for (const auto& [id, force] : simulation.forces()) {
    add_sliders(names.next("force", simulation.name(id)), list_parameters(simulation, id), list);
  }
  for (const auto& [id, collider] : simulation.colliders()) {
    add_sliders(names.next("collider", collider.name), list_parameters(simulation, id), list);
  }
  add_sliders("contact", list_parameters(simulation, pliant::ContactOwner{}), list);
  if (!simulation.contact().surfaces && simulation.colliders().empty()) return list;
  for (Index i = 0; i < pliant::count_of(simulation.bodies()); ++i) {
    const pliant::BodyId id{i};
    add_sliders(names.next("contact", simulation.body(id).name), list_parameters(simulation, id), list);
  }
  return list;
}

}  // namespace pliant_viewer
