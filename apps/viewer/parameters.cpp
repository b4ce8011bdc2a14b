#include "viewer/parameters.h"

#include <cmath>
#include <functional>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "pliant/constraints/builtin.h"
#include "pliant/core/error.h"
#include "pliant/forces/builtin.h"

namespace pliant_viewer {
namespace {

using pliant::OptionInfo;
using pliant::Simulation;
using pliant::Vec3;

/// Calls f with a null pointer to each of the types.
template <class... Types>
void for_each_type(std::tuple<Types...>*, auto&& f) {
  (f(static_cast<Types*>(nullptr)), ...);
}

/// Adds a parameter for each option that is a number, a choice or a vector; to be handed to `visit`.
struct Lister {
  std::string section;
  std::string heading;
  std::vector<Parameter>& list;

  Parameter& add(const OptionInfo& info, ParameterKind kind, const Vec3& value) const {
    return list.emplace_back(Parameter{section, heading, std::string(info.name), std::string(info.unit),
                                       std::string(info.doc), kind, value, info.range});
  }
  void operator()(const OptionInfo& info, const Real& number) const { add(info, ParameterKind::real, {number, 0, 0}); }
  void operator()(const OptionInfo& info, const Index& number) const {
    add(info, ParameterKind::integer, {static_cast<Real>(number), 0, 0});
  }
  void operator()(const OptionInfo& info, const Vec3& vector) const { add(info, ParameterKind::vector, vector); }
  template <class Choice>
  requires std::is_enum_v<Choice>
  void operator()(const OptionInfo& info, const Choice& choice) const {
    constexpr auto names = choice_names(Choice{});
    Parameter& added = add(info, ParameterKind::choice, {static_cast<Real>(choice), 0, 0});
    added.choices.assign(names.begin(), names.end());
    added.range = {0, static_cast<Real>(names.size() - 1)};
  }
  template <class Other>
  requires(!std::is_enum_v<Other>) void operator()(const OptionInfo&, const Other&) const {}  // a list: no slider
};

/// Sets the option of a name; to be handed to `visit`.
struct Setter {
  std::string_view name;
  const Vec3& value;
  bool& was_found;

  bool is_meant(const OptionInfo& info) const {
    if (info.name != name) return false;
    was_found = true;
    return true;
  }
  void check_whole(const OptionInfo& info, Real most) const {
    if (value[0] >= 0 && value[0] <= most && std::floor(value[0]) == value[0]) return;
    pliant::fail_input(fmt::format("{}: {} is no whole number from 0 to {}", info.name, value[0], most));
  }
  void operator()(const OptionInfo& info, Real& number) const {
    if (is_meant(info)) number = value[0];
  }
  void operator()(const OptionInfo& info, Index& number) const {
    if (!is_meant(info)) return;
    check_whole(info, std::numeric_limits<Index>::max());
    number = static_cast<Index>(value[0]);
  }
  void operator()(const OptionInfo& info, Vec3& vector) const {
    if (is_meant(info)) vector = value;
  }
  template <class Choice>
  requires std::is_enum_v<Choice>
  void operator()(const OptionInfo& info, Choice& choice) const {
    if (!is_meant(info)) return;
    check_whole(info, static_cast<Real>(choice_names(Choice{}).size() - 1));
    choice = static_cast<Choice>(static_cast<int>(value[0]));
  }
  template <class Other>
  requires(!std::is_enum_v<Other>) void operator()(const OptionInfo&, Other&) const {}
};

/// "group:stretch", and with a number behind it where that name was taken.
std::string unique_section(std::set<std::string>& taken, std::string_view kind, std::string_view name) {
  std::string section = fmt::format("{}:{}", kind, name);
  for (int number = 2; !taken.insert(section).second; ++number) section = fmt::format("{}:{}:{}", kind, name, number);
  return section;
}

std::string heading_of(std::string_view type, std::string_view name) {
  return type == name ? std::string(type) : fmt::format("{} \"{}\"", type, name);
}

/// Calls f with the section of each group that has a stiffness, and its id.
void for_each_group(const Simulation& simulation, auto&& f) {
  std::set<std::string> taken;
  for (const auto& [id, group] : simulation.groups()) {
    const std::string section = unique_section(taken, "group", group.name);
    if (simulation.stiffness(id)) f(section, id, group);
  }
}

/// Calls f with the section of each force that can be changed, its id, and its options.
void for_each_force(const Simulation& simulation, auto&& f) {
  std::set<std::string> taken;
  for (const auto& [id, force] : simulation.forces()) {
    const std::string section = unique_section(taken, "force", simulation.name(id));
    for_each_type(static_cast<pliant::BuiltinForces*>(nullptr), [&, &id = id](auto* type) {
      using Type = std::remove_pointer_t<decltype(type)>;
      if (const auto* options = simulation.options<Type>(id)) f(section, id, *options);
    });
  }
}

constexpr std::string_view stiffness_name = "stiffness";

/// What the type of a group says of its stiffness; of a type that is not built in, little.
OptionInfo stiffness_info(std::string_view group_type) {
  OptionInfo found{stiffness_name, "", "factor of the weights of all its constraints", pliant::positive};
  for_each_type(static_cast<pliant::BuiltinConstraints*>(nullptr), [&](auto* type) {
    using Type = std::remove_pointer_t<decltype(type)>;
    if (Type::info.name != group_type) return;
    const Type options{};
    Type::visit(options, [&](const OptionInfo& info, const auto&) {
      if (info.name == stiffness_name) found = info;
    });
  });
  return found;
}

}  // namespace

std::vector<Parameter> list_parameters(const Simulation& simulation, std::optional<pliant::GroupId> hidden) {
  std::vector<Parameter> list;
  pliant::SolverSettings::visit(simulation.settings(), Lister{"settings", "solver", list});
  for_each_group(simulation, [&](const std::string& section, pliant::GroupId id, const pliant::Group& group) {
    if (id == hidden) return;
    const Lister lister{section, heading_of(group.type, group.name), list};
    lister(stiffness_info(group.type), *simulation.stiffness(id));
  });
  for_each_force(simulation, [&](const std::string& section, pliant::ForceId id, const auto& options) {
    options.visit(options, Lister{section, heading_of(options.info.name, simulation.name(id)), list});
  });
  return list;
}

bool set_parameter(Simulation& simulation, std::string_view key, const Vec3& value) {
  const std::size_t dot = key.rfind('.');
  if (dot == std::string_view::npos) return false;
  const std::string_view wanted = key.substr(0, dot);
  bool was_found = false;
  const Setter setter{key.substr(dot + 1), value, was_found};
  if (wanted == "settings") {
    pliant::SolverSettings settings = simulation.settings();
    pliant::SolverSettings::visit(settings, setter);
    if (was_found) simulation.set_settings(settings);
    return was_found;
  }
  std::optional<pliant::GroupId> found_group;
  for_each_group(simulation, [&](const std::string& section, pliant::GroupId id, const pliant::Group&) {
    if (section == wanted) found_group = id;
  });
  if (found_group) {
    Real stiffness = 0;
    setter(OptionInfo{stiffness_name, "", ""}, stiffness);
    if (was_found) simulation.set_stiffness(*found_group, stiffness);
    return was_found;
  }
  std::function<void()> change;  // once the list of forces is no longer gone through
  for_each_force(simulation, [&](const std::string& section, pliant::ForceId id, const auto& options) {
    if (section != wanted || was_found) return;
    auto changed = options;
    changed.visit(changed, setter);
    if (was_found) change = [&simulation, id, changed] { simulation.replace(id, changed); };
  });
  if (change) change();
  return was_found;
}

}  // namespace pliant_viewer
