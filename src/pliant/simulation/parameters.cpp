#include "pliant/simulation/parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/simulation/group_stiffness.h"

namespace pliant {
namespace {

/// Adds a parameter for each option that is a number, a flag, a choice or a vector.
class ParameterLister final : public OptionLister {
 public:
  ParameterLister(const ParameterOwner& owner, std::string_view type, std::string_view name,
                  std::vector<Parameter>& list)
      : owner_(owner), type_(type), name_(name), list_(list) {}

  // Of groups, what may have changed since they were made.
  const Values* stiffnesses = nullptr;  // among the options
  std::optional<Real> factor{};         // of all stiffnesses
  const Points* anchors = nullptr;      // among the options
  std::optional<Vec3> anchor{};         // of the first constraint
  std::optional<Real> otherwise{};      // what a number is that need not be given

  void list(const OptionInfo& info, const Real& number) override { add(info, ParameterKind::real, {number, 0, 0}); }
  void list(const OptionInfo& info, const Index& number) override {
    Range& range = add(info, ParameterKind::integer, {static_cast<Real>(number), 0, 0}).range;
    range.min = std::max<Real>(range.min, std::numeric_limits<Index>::min());
    range.max = std::min<Real>(range.max, std::numeric_limits<Index>::max());
  }
  void list(const OptionInfo& info, const std::optional<Real>& number) override {
    if (number || otherwise) list(info, number ? *number : *otherwise);
  }
  void list(const OptionInfo& info, const bool& flag) override {
    add(info, ParameterKind::flag, {flag ? 1.0 : 0.0, 0, 0}).range = {0, 1};
  }
  void list(const OptionInfo& info, const Vec3& vector) override { add(info, ParameterKind::vector, vector); }
  void list(const OptionInfo& info, const Values& values) override {
    if (&values == stiffnesses) return add_stiffness(info, values.each());
    if (!values.empty() && !values.each()) add(info, ParameterKind::real, {values[0], 0, 0});
  }
  void list(const OptionInfo& info, const Points& points) override {
    if (points.empty() || points.each()) return;
    add(info, ParameterKind::vector, &points == anchors && anchor ? *anchor : points[0]);
  }
  void list(const OptionInfo& info, std::span<const std::string_view> names, int chosen) override {
    Parameter& added = add(info, ParameterKind::choice, {static_cast<Real>(chosen), 0, 0});
    added.choices.assign(names.begin(), names.end());
    added.range = {0, static_cast<Real>(names.size() - 1)};
  }
  void add_stiffness(const OptionInfo& info, bool is_factor) {
    if (!factor) return;
    Parameter& added = add(info, ParameterKind::real, {*factor, 0, 0});
    if (!is_factor) return;
    added.unit.clear();
    added.doc = "factor of the stiffnesses, which each constraint has for itself; " + added.doc;
  }

 private:
  Parameter& add(const OptionInfo& info, ParameterKind kind, const Vec3& value) {
    return list_.emplace_back(Parameter{{owner_, std::string(info.name)},
                                        type_,
                                        name_,
                                        std::string(info.unit),
                                        std::string(info.doc),
                                        kind,
                                        value,
                                        info.range});
  }

  ParameterOwner owner_;
  std::string type_;
  std::string name_;
  std::vector<Parameter>& list_;
};

/// Sets the option of a name.
class ParameterSetter final : public OptionSetter {
 public:
  ParameterSetter(std::string_view option, const Vec3& value) : option_(option), value_(value) {}

  void set(const OptionInfo& info, Real& number) override { set_if_meant(info, number, value_[0]); }
  void set(const OptionInfo& info, Index& number) override {
    set_if_meant(info, number, static_cast<Index>(value_[0]));
  }
  void set(const OptionInfo& info, std::optional<Real>& number) override { set_if_meant(info, number, value_[0]); }
  void set(const OptionInfo& info, bool& flag) override { set_if_meant(info, flag, value_[0] != 0); }
  void set(const OptionInfo& info, Vec3& vector) override { set_if_meant(info, vector, value_); }
  void set(const OptionInfo& info, Values& values) override { set_if_meant(info, values, value_[0]); }
  void set(const OptionInfo& info, Points& points) override { set_if_meant(info, points, value_); }
  void set_choice(const OptionInfo& info, int& chosen) override {
    set_if_meant(info, chosen, static_cast<int>(value_[0]));
  }

 private:
  template <class Option, class Value>
  void set_if_meant(const OptionInfo& info, Option& option, const Value& value) {
    if (info.name != option_) return;
    option = value;
    changed_ = &option;
  }

  std::string_view option_;
  Vec3 value_;
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

void list_settings(const Simulation& simulation, std::vector<Parameter>& list) {
  SolverSettings settings = simulation.settings();
  settings.iterations = iterations_of(settings, simulation.state().iterations);
  ParameterLister lister({}, "", "", list);
  list_options(settings, lister);
}

void list_group(const Simulation& simulation, GroupId id, std::vector<Parameter>& list) {
  const Group& group = group_with(simulation, id);
  ParameterLister lister(id, group.type, group.name, list);
  lister.factor = simulation.stiffness(id);
  lister.anchor = first_anchor(group);
  if (group.source == nullptr) return lister.add_stiffness(stiffness_alone, false);
  lister.stiffnesses = group.source->stiffness();
  lister.anchors = group.source->anchors();
  const auto first = static_cast<std::ptrdiff_t>(list.size());
  group.source->list(lister);
  const auto is_stiffness = [](const Parameter& each) { return each.handle.option == stiffness_alone.name; };
  const auto stiffness = std::find_if(list.begin() + first, list.end(), is_stiffness);
  if (stiffness != list.end() && !stiffness->unit.empty()) stiffness->unit = stiffness_unit(group);
  if (lister.stiffnesses != nullptr) return;
  if (stiffness == list.end()) lister.add_stiffness(stiffness_alone, false);
}

/// Whether "stiffness" is the common factor of a group, and no option that its constraints are made anew of.
bool is_factor_of(const Group& group) {
  if (group.source == nullptr || group.source->stiffness() != nullptr) return true;
  std::vector<Parameter> options;
  ParameterLister lister({}, "", "", options);
  group.source->list(lister);
  return std::ranges::none_of(options,
                              [](const Parameter& each) { return each.handle.option == stiffness_alone.name; });
}

void list_force(const Simulation& simulation, ForceId id, std::vector<Parameter>& list) {
  const ForceRecord& record = simulation.record(id);
  if (record.source == nullptr) return;
  ParameterLister lister(id, simulation.forces().at(id)->type(), record.name, list);
  record.source->list(lister);
}

void list_collider(const Simulation& simulation, ColliderId id, std::vector<Parameter>& list) {
  const ColliderRecord& record = simulation.collider(id);
  if (record.source == nullptr) return;
  ParameterLister lister(id, record.shape->type(), record.name, list);
  record.source->list(lister);
}

void list_contact(const Simulation& simulation, std::vector<Parameter>& list) {
  ParameterLister lister(ContactOwner{}, "contact", "contact", list);
  list_options(simulation.contact(), lister);
}

void list_body(const Simulation& simulation, BodyId id, std::vector<Parameter>& list) {
  ParameterLister lister(id, "contact", simulation.body(id).name, list);
  lister.otherwise = simulation.contact().friction;
  list_options(simulation.contact(id), lister);
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

/// Of settings that a simulation takes as a whole.
template <class Settings>
Settings changed(Settings settings, const Parameter& parameter, const Vec3& value) {
  ParameterSetter setter(parameter.handle.option, value);
  set_options(settings, setter);
  return settings;
}

void set_of_group(Simulation& simulation, GroupId id, const Parameter& parameter, const Vec3& value) {
  const Group& group = group_with(simulation, id);
  const std::shared_ptr<const AnyOptions> source = group.source;  // is exchanged meanwhile
  if (parameter.handle.option == stiffness_alone.name && is_factor_of(group)) {
    return simulation.set_stiffness(id, value[0]);
  }
  ParameterSetter setter(parameter.handle.option, value);
  source->change(simulation, static_cast<Index>(id), setter);
}

/// Of a force or a collider.
void set_of_source(Simulation& simulation, std::shared_ptr<const AnyOptions> source, Index number,
                   const Parameter& parameter, const Vec3& value) {
  ParameterSetter setter(parameter.handle.option, value);
  source->change(simulation, number, setter);
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
    set_of_source(simulation, simulation.record(*force).source, static_cast<Index>(*force), meant, value);
  } else if (const auto* collider = std::get_if<ColliderId>(&handle.owner)) {
    set_of_source(simulation, simulation.collider(*collider).source, static_cast<Index>(*collider), meant, value);
  } else if (std::holds_alternative<ContactOwner>(handle.owner)) {
    simulation.set_contact(changed(simulation.contact(), meant, value));
  } else if (const auto* body = std::get_if<BodyId>(&handle.owner)) {
    simulation.set_contact(*body, changed(simulation.contact(*body), meant, value));
  } else {
    simulation.set_settings(changed(simulation.settings(), meant, value));
  }
}

}  // namespace pliant
