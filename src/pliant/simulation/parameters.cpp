#include "pliant/simulation/parameters.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>

#include <fmt/format.h>

#include "pliant/collision/colliders/builtin.h"
#include "pliant/constraints/builtin.h"
#include "pliant/core/error.h"
#include "pliant/forces/builtin.h"

namespace pliant {
namespace {

/// Calls f with a null pointer to each of the types.
template <class... Types>
void for_each_type(std::tuple<Types...>*, auto&& f) {
  (f(static_cast<Types*>(nullptr)), ...);
}

template <class Type>
concept is_choice = std::is_enum_v<Type>;

/// Adds a parameter for each option that is a number, a choice or a vector; to be handed to `visit`.
struct ParameterLister {
  ParameterOwner owner;
  std::string type;
  std::string name;
  std::vector<Parameter>& list;
  // Of groups, what may have changed since they were made.
  const Values* stiffnesses = nullptr;  // among the options
  std::optional<Real> factor{};         // of all stiffnesses
  const Points* anchors = nullptr;      // among the options
  std::optional<Vec3> anchor{};         // of the first constraint
  std::optional<Real> otherwise{};      // what a number is that need not be given

  Parameter& add(const OptionInfo& info, ParameterKind kind, const Vec3& value) const {
    return list.emplace_back(Parameter{{owner, std::string(info.name)},
                                       type,
                                       name,
                                       std::string(info.unit),
                                       std::string(info.doc),
                                       kind,
                                       value,
                                       info.range});
  }
  void add_stiffness(const OptionInfo& info, bool is_factor) const {
    if (!factor) return;
    Parameter& added = add(info, ParameterKind::real, {*factor, 0, 0});
    if (!is_factor) return;
    added.unit.clear();
    added.doc = "factor of the stiffnesses, which each constraint has for itself; " + added.doc;
  }
  void operator()(const OptionInfo& info, const Real& number) const { add(info, ParameterKind::real, {number, 0, 0}); }
  void operator()(const OptionInfo& info, const Index& number) const {
    Range& range = add(info, ParameterKind::integer, {static_cast<Real>(number), 0, 0}).range;
    range.min = std::max<Real>(range.min, std::numeric_limits<Index>::min());
    range.max = std::min<Real>(range.max, std::numeric_limits<Index>::max());
  }
  void operator()(const OptionInfo& info, const std::optional<Real>& number) const {
    if (number || otherwise) (*this)(info, number ? *number : *otherwise);
  }
  void operator()(const OptionInfo& info, const bool& flag) const {
    add(info, ParameterKind::flag, {flag ? 1.0 : 0.0, 0, 0}).range = {0, 1};
  }
  void operator()(const OptionInfo& info, const Vec3& vector) const { add(info, ParameterKind::vector, vector); }
  void operator()(const OptionInfo& info, const Values& values) const {
    if (&values == stiffnesses) return add_stiffness(info, values.each());
    if (!values.empty() && !values.each()) add(info, ParameterKind::real, {values[0], 0, 0});
  }
  void operator()(const OptionInfo& info, const Points& points) const {
    if (points.empty() || points.each()) return;
    add(info, ParameterKind::vector, &points == anchors && anchor ? *anchor : points[0]);
  }
  void operator()(const OptionInfo& info, const is_choice auto& choice) const {
    constexpr auto names = choice_names(std::remove_cvref_t<decltype(choice)>{});
    Parameter& added = add(info, ParameterKind::choice, {static_cast<Real>(choice), 0, 0});
    added.choices.assign(names.begin(), names.end());
    added.range = {0, static_cast<Real>(names.size() - 1)};
  }
  void operator()(const OptionInfo&, const auto&) const {}  // a selection or a list
};

/// Sets the option of a name; to be handed to `visit`.
struct ParameterSetter {
  const Parameter& parameter;
  const Vec3& value;
  const void*& changed;

  bool is_meant(const OptionInfo& info, const void* place) const {
    if (info.name != parameter.handle.option) return false;
    changed = place;
    return true;
  }
  void operator()(const OptionInfo& info, Real& number) const {
    if (is_meant(info, &number)) number = value[0];
  }
  void operator()(const OptionInfo& info, Index& number) const {
    if (is_meant(info, &number)) number = static_cast<Index>(value[0]);
  }
  void operator()(const OptionInfo& info, std::optional<Real>& number) const {
    if (is_meant(info, &number)) number = value[0];
  }
  void operator()(const OptionInfo& info, bool& flag) const {
    if (is_meant(info, &flag)) flag = value[0] != 0;
  }
  void operator()(const OptionInfo& info, Vec3& vector) const {
    if (is_meant(info, &vector)) vector = value;
  }
  void operator()(const OptionInfo& info, Values& values) const {
    if (is_meant(info, &values)) values = value[0];
  }
  void operator()(const OptionInfo& info, Points& points) const {
    if (is_meant(info, &points)) points = value;
  }
  template <is_choice Choice>
  void operator()(const OptionInfo& info, Choice& choice) const {
    if (is_meant(info, &choice)) choice = static_cast<Choice>(static_cast<int>(value[0]));
  }
  template <class Other>
  requires(!is_choice<Other>) void operator()(const OptionInfo&, Other&) const {}
};

const OptionInfo stiffness_alone{"stiffness", "", "factor of the weights of all its constraints", positive};

/// Where the first constraint of a group has its target or origin.
std::optional<Vec3> first_anchor(const Group& group) {
  if (group.set.batches.empty()) return std::nullopt;
  const std::span<const Real> anchor = group.set.batches.front()->anchor(0);
  if (anchor.size() < 3) return std::nullopt;
  return Eigen::Map<const Vec3>(anchor.data());
}

const Group& group_with(const Simulation& simulation, GroupId id) {
  const auto found = simulation.groups().find(id);
  if (found == simulation.groups().end()) {
    fail_input(fmt::format("group {} does not exist; give one that was added and not removed", static_cast<Index>(id)));
  }
  return found->second;
}

/// Calls f with the options that a group was made of; false where they are not of a built-in type.
bool with_options(const Group& group, auto&& f) {
  bool is_built_in = false;
  const auto try_type = [&](auto* type) {
    const auto* options = options_in<std::remove_pointer_t<decltype(type)>>(group);
    if (options == nullptr) return;
    is_built_in = true;
    f(*options);
  };
  for_each_type(static_cast<BuiltinConstraints*>(nullptr), try_type);
  try_type(static_cast<Attachment*>(nullptr));
  return is_built_in;
}

void list_settings(const Simulation& simulation, std::vector<Parameter>& list) {
  SolverSettings settings = simulation.settings();
  settings.iterations = iterations_of(settings, simulation.state().iterations);
  SolverSettings::visit(settings, ParameterLister{{}, "", "", list});
}

void list_group(const Simulation& simulation, GroupId id, std::vector<Parameter>& list) {
  const Group& group = group_with(simulation, id);
  ParameterLister lister{id, group.type, group.name, list};
  lister.factor = simulation.stiffness(id);
  lister.anchor = first_anchor(group);
  const bool is_built_in = with_options(group, [&](const auto& options) {
    lister.stiffnesses = &options.stiffness;
    lister.anchors = anchors_in(options);
    options.visit(options, lister);
  });
  if (!is_built_in) lister.add_stiffness(stiffness_alone, false);
}

void list_force(const Simulation& simulation, ForceId id, std::vector<Parameter>& list) {
  const std::string& name = simulation.name(id);
  for_each_type(static_cast<BuiltinForces*>(nullptr), [&](auto* type) {
    const auto* options = simulation.options<std::remove_pointer_t<decltype(type)>>(id);
    if (options != nullptr) options->visit(*options, ParameterLister{id, std::string(options->info.name), name, list});
  });
}

void list_collider(const Simulation& simulation, ColliderId id, std::vector<Parameter>& list) {
  const std::string& name = simulation.name(id);
  for_each_type(static_cast<BuiltinColliders*>(nullptr), [&](auto* type) {
    const auto* options = simulation.options<std::remove_pointer_t<decltype(type)>>(id);
    if (options != nullptr) options->visit(*options, ParameterLister{id, std::string(options->info.name), name, list});
  });
}

void list_contact(const Simulation& simulation, std::vector<Parameter>& list) {
  ContactSettings::visit(simulation.contact(), ParameterLister{ContactOwner{}, "contact", "contact", list});
}

void list_body(const Simulation& simulation, BodyId id, std::vector<Parameter>& list) {
  ParameterLister lister{id, "contact", simulation.body(id).name, list};
  lister.otherwise = simulation.contact().friction;
  BodyContact::visit(simulation.contact(id), lister);
}

/// "triangle_strain: min_stretch: -1 is out of range; give a finite number from 0".
void check_value(const Parameter& parameter, const Vec3& value) {
  const std::string place = (parameter.type.empty() ? "settings" : parameter.type) + ": " + parameter.handle.option;
  const OptionInfo info{parameter.handle.option, parameter.unit, "", parameter.range};
  const int count = parameter.kind == ParameterKind::vector ? 3 : 1;
  for (int i = 0; i < count; ++i) {
    if (const auto error = range_error(info, value[i])) fail_input(place + ": " + *error);
  }
  if (parameter.kind == ParameterKind::real || parameter.kind == ParameterKind::vector) return;
  if (std::floor(value[0]) != value[0]) {
    fail_input(fmt::format("{}: {} is not a whole number; give one from {} to {}", place, value[0], parameter.range.min,
                           parameter.range.max));
  }
}

void set_of_settings(Simulation& simulation, const Parameter& parameter, const Vec3& value) {
  SolverSettings settings = simulation.settings();
  const void* changed = nullptr;
  SolverSettings::visit(settings, ParameterSetter{parameter, value, changed});
  simulation.set_settings(settings);
}

void set_of_group(Simulation& simulation, GroupId id, const Parameter& parameter, const Vec3& value) {
  if (parameter.handle.option == stiffness_alone.name) return simulation.set_stiffness(id, value[0]);
  std::function<void()> change;  // when the options that the group has are no longer in use
  with_options(group_with(simulation, id), [&]<class Type>(const Type&) {
    Type options = *simulation.options<Type>(id);
    const void* changed = nullptr;
    Type::visit(options, ParameterSetter{parameter, value, changed});
    const Anchors anchors = changed == anchors_in(options) ? Anchors::given : Anchors::kept;
    change = [&simulation, id, options = std::move(options), anchors] { simulation.replace(id, options, anchors); };
  });
  change();
}

/// Of a force or a collider, of one of the built-in types.
template <class Types, class Id>
void set_of_listed(Simulation& simulation, Id id, const Parameter& parameter, const Vec3& value) {
  std::function<void()> change;  // as above
  for_each_type(static_cast<Types*>(nullptr), [&](auto* type) {
    using Type = std::remove_pointer_t<decltype(type)>;
    const Type* given = simulation.options<Type>(id);
    if (given == nullptr) return;
    Type options = *given;
    const void* changed = nullptr;
    Type::visit(options, ParameterSetter{parameter, value, changed});
    change = [&simulation, id, options = std::move(options)] { simulation.replace(id, options); };
  });
  change();
}

void set_of_contact(Simulation& simulation, const Parameter& parameter, const Vec3& value) {
  ContactSettings settings = simulation.contact();
  const void* changed = nullptr;
  ContactSettings::visit(settings, ParameterSetter{parameter, value, changed});
  simulation.set_contact(settings);
}

void set_of_body(Simulation& simulation, BodyId id, const Parameter& parameter, const Vec3& value) {
  BodyContact contact = simulation.contact(id);
  const void* changed = nullptr;
  BodyContact::visit(contact, ParameterSetter{parameter, value, changed});
  simulation.set_contact(id, contact);
}

}  // namespace

std::vector<Parameter> list_parameters(const Simulation& simulation) {
  std::vector<Parameter> list;
  list_settings(simulation, list);
  for (const auto& [id, group] : simulation.groups()) list_group(simulation, id, list);
  for (const auto& [id, force] : simulation.forces()) list_force(simulation, id, list);
  for (const auto& [id, collider] : simulation.colliders()) list_collider(simulation, id, list);
  list_contact(simulation, list);
  if (!simulation.contact().surfaces && simulation.colliders().empty()) return list;
  for (Index i = 0; i < count_of(simulation.bodies()); ++i) list_body(simulation, BodyId{i}, list);
  return list;
}

std::vector<Parameter> list_parameters(const Simulation& simulation, const ParameterOwner& owner) {
  std::vector<Parameter> list;
  if (const auto* group = std::get_if<GroupId>(&owner)) {
    list_group(simulation, *group, list);
  } else if (const auto* force = std::get_if<ForceId>(&owner)) {
    list_force(simulation, *force, list);
  } else if (const auto* collider = std::get_if<ColliderId>(&owner)) {
    list_collider(simulation, *collider, list);
  } else if (std::holds_alternative<ContactOwner>(owner)) {
    list_contact(simulation, list);
  } else if (const auto* body = std::get_if<BodyId>(&owner)) {
    list_body(simulation, *body, list);
  } else {
    list_settings(simulation, list);
  }
  return list;
}

Parameter parameter(const Simulation& simulation, const ParameterHandle& handle) {
  const std::vector<Parameter> list = list_parameters(simulation, handle.owner);
  const auto found = std::ranges::find(list, handle, &Parameter::handle);
  if (found != list.end()) return *found;
  std::string names;
  for (const Parameter& each : list) names += (names.empty() ? "" : ", ") + each.handle.option;
  fail_input(fmt::format("unknown parameter '{}'{}", handle.option, names.empty() ? "" : "; known: " + names));
}

void set_parameter(Simulation& simulation, const ParameterHandle& handle, const Vec3& value) {
  const Parameter meant = parameter(simulation, handle);
  check_value(meant, value);
  if (const auto* group = std::get_if<GroupId>(&handle.owner)) {
    set_of_group(simulation, *group, meant, value);
  } else if (const auto* force = std::get_if<ForceId>(&handle.owner)) {
    set_of_listed<BuiltinForces>(simulation, *force, meant, value);
  } else if (const auto* collider = std::get_if<ColliderId>(&handle.owner)) {
    set_of_listed<BuiltinColliders>(simulation, *collider, meant, value);
  } else if (std::holds_alternative<ContactOwner>(handle.owner)) {
    set_of_contact(simulation, meant, value);
  } else if (const auto* body = std::get_if<BodyId>(&handle.owner)) {
    set_of_body(simulation, *body, meant, value);
  } else {
    set_of_settings(simulation, meant, value);
  }
}

}  // namespace pliant
