#include "pliant_io/scene/detail/constraint_options.h"

namespace pliant {
namespace {

/// Reads options of the type Constraint if that is what `type` names.
template <class Constraint>
bool read_as(const Node& node, std::string_view type, const std::vector<std::string_view>& keys, const SceneBody& body,
             ConstraintOptions& options) {
  if (Constraint::info.name != type) return false;
  read_options(node, options.emplace<Constraint>(), keys, &body);
  return true;
}

template <class... Constraint>
ConstraintOptions read_any(const Node& node, const std::vector<std::string_view>& keys, const SceneBody& body,
                           std::tuple<Constraint...>*) {
  const Node type = node.require("type");
  std::string name;
  read(type, name);
  ConstraintOptions options;
  if ((read_as<Constraint>(node, name, keys, body, options) || ...)) return options;
  type.fail(
      fmt::format("unknown constraint '{}'; {}", printable(name), suggestion_text(name, {Constraint::info.name...})));
}

}  // namespace

ConstraintOptions read_constraint_options(const Node& node, std::vector<std::string_view> more_keys,
                                          const SceneBody& body) {
  more_keys.push_back("type");
  return read_any(node, more_keys, body, static_cast<BuiltinConstraints*>(nullptr));
}

void read_changed_options(const Node& node, std::vector<std::string_view> more_keys, const SceneBody& body,
                          ConstraintOptions& options) {
  const auto change = [&](auto& of_type) {
    const bool has_new_places = node.has("on") || node.has("stencils");
    constexpr bool is_between_bodies = between_bodies<std::remove_cvref_t<decltype(of_type)>>;
    if (has_new_places && !is_between_bodies) {
      if constexpr (requires { of_type.on; }) of_type.on = {};
      if constexpr (requires { of_type.stencils; }) of_type.stencils = {};
      if constexpr (requires { of_type.targets; }) of_type.targets = {};
      if constexpr (requires { of_type.origin; }) of_type.origin = {};
    }
    read_options(node, of_type, std::move(more_keys), is_between_bodies ? nullptr : &body);
    node.locate([&] { check_options(of_type.info.name, of_type); });
  };
  std::visit(change, options);
}

std::string_view type_of(const ConstraintOptions& options) {
  return std::visit([](const auto& of_type) { return of_type.info.name; }, options);
}

const Values& stiffness_of(const ConstraintOptions& options) {
  return std::visit([](const auto& of_type) -> const Values& { return of_type.stiffness; }, options);
}

GroupId add(Simulation& simulation, BodyId body, const ConstraintOptions& options, const std::string& name) {
  return std::visit([&](const auto& of_type) { return simulation.add(body, of_type, name); }, options);
}

void replace(Simulation& simulation, GroupId group, const ConstraintOptions& options, Anchors anchors) {
  std::visit([&](const auto& of_type) { simulation.replace(group, of_type, anchors); }, options);
}

}  // namespace pliant
