#include "pliant_io/scene/detail/schema_parts.h"

#include <set>

#include "pliant/constraints/builtin.h"
#include "pliant/forces/builtin.h"
#include "pliant/materials/material_groups.h"
#include "pliant/mesh/lattice.h"
#include "pliant_io/mesh/mesh_file.h"
#include "pliant_io/scene/animation_options.h"
#include "pliant_io/scene/detail/collider_options.h"
#include "pliant_io/scene/detail/force_options.h"
#include "pliant_io/scene/event_options.h"
#include "pliant_io/scene/shape_options.h"

namespace pliant {
namespace {

SchemaJson vertex_schema() {
  return {{"type", "integer"}, {"minimum", 0}};
}

SchemaJson joined(SchemaJson properties, const SchemaJson& more) {
  properties.update(more);
  return properties;
}

/// What a definition says, with more keys, and none besides.
SchemaJson closed_reference(std::string_view definition, SchemaJson more = SchemaJson::object()) {
  SchemaJson schema = schema_reference(definition);
  if (!more.empty()) schema["properties"] = std::move(more);
  schema["unevaluatedProperties"] = false;
  return schema;
}

template <class Options>
SchemaJson shape_schema() {
  const SchemaJson properties = {{"shape", {{"const", Options::shape}}}};
  SchemaJson schema = open_object_schema(joined(properties, options_properties<Options>()), {"shape"});
  schema["description"] = Options::summary;
  return schema;
}

template <class... Options>
void add_shapes(SchemaJson& choices, std::tuple<Options...>*) {
  (choices.push_back(shape_schema<Options>()), ...);
}

SchemaJson enabled_schema() {
  return {{"type", "boolean"}, {"default", true}, {"description", "false: it is switched off, and keeps its name"}};
}

/// A mesh of any kind.
SchemaJson mesh_choices() {
  SchemaJson file = {{"file", text_schema("path of a mesh file, from the folder of the scene")},
                     {"source", text_schema("how to get the file, for the message when it is missing")}};
  file.update(options_properties<ImportOptions>());
  const SchemaJson lists = {{"vertices", list_schema(schema_reference("vector"))},
                            {"edges", list_schema(list_schema(vertex_schema(), 2))},
                            {"triangles", list_schema(list_schema(vertex_schema(), 3))},
                            {"tetrahedra", list_schema(list_schema(vertex_schema(), 4))}};
  const SchemaJson weld = {{"type", "number"}, {"minimum", 0}, {"description", "vertices so near become one [m]"}};
  const SchemaJson parts = {{"parts", list_schema(schema_reference("mesh_part"))}, {"weld", weld}};
  SchemaJson choices = {open_object_schema(std::move(file), {"file"}), open_object_schema(lists, {"vertices"}),
                        open_object_schema(parts, {"parts"})};
  add_shapes(choices, static_cast<Shapes*>(nullptr));
  return {{"oneOf", std::move(choices)}};
}

template <class Constraint>
SchemaJson constraint_type_schema() {
  const SchemaJson properties = {{"type", {{"const", Constraint::info.name}}},
                                 {"name", text_schema("what others refer to it by")},
                                 {"enabled", enabled_schema()}};
  SchemaJson schema = open_object_schema(joined(properties, options_properties<Constraint>()), {"type"});
  schema["description"] = std::string(Constraint::info.energy);
  return schema;
}

template <class... Constraint>
SchemaJson constraint_choices(std::tuple<Constraint...>*) {
  SchemaJson choices = SchemaJson::array();
  (choices.push_back(constraint_type_schema<Constraint>()), ...);
  return choices;
}

template <class Options>
void add_force(SchemaJson& choices) {
  if constexpr (is_listed_force<Options>) {
    SchemaJson properties = {{"type", {{"const", Options::info.name}}},
                             {"name", text_schema("what events refer to it by")},
                             {"body", text_schema("name of the body; default: the only one")},
                             {"enabled", enabled_schema()}};
    properties.update(options_properties<Options>());
    std::vector<std::string_view> required = {"type"};
    if (!Options::info.required.empty()) {
      required.push_back(Options::info.required);
      properties[std::string(Options::info.required)].erase("default");
    }
    constexpr bool has_vertices = requires(Options options) {
      options.vertices;
    };
    if (has_vertices) {
      properties["vertices"].erase("default");
      properties["vertex"] = vertex_schema();
    }
    SchemaJson schema = object_schema(std::move(properties), std::move(required));
    if (has_vertices) schema["oneOf"] = {{{"required", {"vertex"}}}, {{"required", {"vertices"}}}};
    choices.push_back(std::move(schema));
  }
}

template <class... Options>
void add_forces(SchemaJson& choices, std::tuple<Options...>*) {
  (add_force<Options>(choices), ...);
}

SchemaJson force_choices() {
  SchemaJson choices = SchemaJson::array();
  add_forces(choices, static_cast<BuiltinForces*>(nullptr));
  return choices;
}

template <class Options>
SchemaJson collider_schema() {
  SchemaJson properties = {{"type", {{"const", Options::info.name}}},
                           {"name", text_schema("what events refer to it by")},
                           {"enabled", enabled_schema()}};
  properties.update(options_properties<Options>());
  SchemaJson friction = number_schema("number", not_negative);  // one for all of its surface
  friction["description"] = properties["friction"]["description"];
  properties["friction"] = std::move(friction);
  properties["appearance"] = object_schema(options_properties<ColliderAppearance>());
  SchemaJson schema = object_schema(std::move(properties), {"type"});
  schema["description"] = std::string(Options::info.formula);
  return schema;
}

template <class... Options>
SchemaJson collider_choices(std::tuple<Options...>*) {
  return SchemaJson::array({collider_schema<Options>()...});
}

SchemaJson collider_choices() {
  return collider_choices(static_cast<BuiltinColliders*>(nullptr));
}

/// An object of which one of the keys must be there, and no two.
SchemaJson one_of_keys(std::initializer_list<const char*> keys) {
  SchemaJson choices = SchemaJson::array();
  for (const char* key : keys) choices.push_back({{"required", SchemaJson::array({key})}});
  return {{"oneOf", std::move(choices)}};
}

/// What happens at a step or a time: `key` with what it means, and more properties.
SchemaJson timed_schema(std::string_view key, SchemaJson value, const SchemaJson& more = SchemaJson::object()) {
  const SchemaJson properties = {{std::string(key), std::move(value)}};
  SchemaJson schema = open_object_schema(joined(properties, more), {key});
  schema["allOf"] = SchemaJson::array({schema_reference("when")});
  schema["unevaluatedProperties"] = false;
  return schema;
}

SchemaJson timed_move_schema(std::string_view key) {
  SchemaJson schema = timed_schema(key, schema_reference("moved_group"));
  schema["allOf"].push_back(schema_reference("move"));
  return schema;
}

/// Every option of a constraint, a force or a collider may be changed; which ones there are depends on what the name
/// stands for.
SchemaJson change_schema() {
  SchemaJson names = {"change", "step", "time"};
  const auto add = [&](const SchemaJson& properties) {
    for (const auto& [name, schema] : properties.items()) {
      if (name != "type" && name != "name" && name != "enabled" && name != "appearance") names.push_back(name);
    }
  };
  add(options_properties<RampOptions>());
  const SchemaJson constraints = constraint_choices(static_cast<BuiltinConstraints*>(nullptr));
  for (const SchemaJson& type : constraints) add(type["properties"]);
  add(options_properties<Attachment>());
  for (const SchemaJson& type : force_choices()) add(type["properties"]);
  for (const SchemaJson& type : collider_choices()) add(type["properties"]);
  SchemaJson schema = timed_schema("change", text_schema("name of a group, a force or a collider"));
  schema.erase("unevaluatedProperties");
  std::set<std::string> sorted(names.begin(), names.end());
  schema["propertyNames"] = {{"enum", sorted}};
  return schema;
}

SchemaJson body_contact_schema() {
  SchemaJson properties = options_properties<BodyContact>();
  properties["ignores"] = list_schema(text_schema("name of a body that it does not touch"));
  return object_schema(std::move(properties));
}

SchemaJson animation_schema() {
  const SchemaJson name = {{"name", text_schema("what events refer to it by")}};
  SchemaJson frames = options_properties<FrameAnimation>();
  frames["frames"] = text_schema("a PC2, MDD or NPY file, or meshes whose numbers a star stands for: walk_*.obj");
  return {{"oneOf",
           {object_schema(joined(options_properties<SteadyAnimation>(), name)),
            object_schema(joined(std::move(frames), name), {"frames"})}}};
}

/// Of a body, to tell it from an event of the scene's contact.
SchemaJson body_contact_event_schema() {
  const SchemaJson body = {{"body", text_schema("name of the body")}};
  SchemaJson schema = timed_schema("contact", schema_reference("body_contact"), body);
  schema["required"].push_back("body");
  return schema;
}

SchemaJson add_schema() {
  const SchemaJson body = {{"body", text_schema("name of the body; default: the only one")}};
  const SchemaJson attachment = {{"type", {{"const", Attachment::info.name}}}};
  return {{"oneOf",
           {closed_reference("constraint", body), closed_reference("attachment", attachment), schema_reference("force"),
            schema_reference("collider")}},
          {"not", {{"required", {"enabled"}}}}};
}

SchemaJson follow_schema() {
  SchemaJson properties = options_properties<FollowOptions>();
  properties.update(options_properties<FileOptions>());
  properties["body"] = text_schema("whose vertices are followed");
  properties["file"] = text_schema("of frames whose vertices are followed: PC2, MDD or NPY");
  SchemaJson schema = timed_schema("follow", schema_reference("moved_group"), properties);
  schema["allOf"].push_back(one_of_keys({"body", "file"}));
  return schema;
}

}  // namespace

SchemaJson text_schema(std::string_view description) {
  return {{"type", "string"}, {"description", description}};
}

SchemaJson mesh_schema() {
  return closed_reference("mesh");
}

SchemaJson constraint_schema() {
  return closed_reference("constraint");
}

SchemaJson mass_schema() {
  SchemaJson properties = SchemaJson::object();
  const auto add = [&](const char* key, std::string_view unit) {
    properties[key] = {{"type", "number"}, {"exclusiveMinimum", 0}, {"description", "[" + std::string(unit) + "]"}};
  };
  add("per_vertex", "kg");
  add("total", "kg");
  add("area_density", "kg/m²");
  add("density", "kg/m³");
  add("line_density", "kg/m");
  SchemaJson list = list_schema(number_schema("number", positive));
  properties["each"] = {{"anyOf", {std::move(list), schema_reference("mapped_values")}},
                        {"description", "one for each vertex [kg]"}};
  SchemaJson schema = object_schema(std::move(properties));
  schema["minProperties"] = 1;
  const SchemaJson densities = {"area_density", "density", "line_density"};
  schema["anyOf"] = {{{"maxProperties", 1}}, {{"propertyNames", {{"enum", densities}}}}};  // densities add up
  return schema;
}

namespace {

SchemaJson attachment_schema() {
  const SchemaJson side =
      object_schema({{"body", text_schema("name of the body")}, {"on", schema_reference("selection")}}, {"body"});
  const SchemaJson properties = {{"name", text_schema("what events refer to it by")},
                                 {"enabled", enabled_schema()},
                                 {"from", described(side, "vertices that are tied")},
                                 {"to", described(side, "what they are tied to, which may be of the same body")}};
  SchemaJson schema = open_object_schema(joined(properties, options_properties<Attachment>()), {"from", "to"});
  schema["description"] = std::string(Attachment::info.energy);
  return schema;
}

/// The numbers of materials; none has a default, since they are those of the material that is named.
SchemaJson material_numbers() {
  SchemaJson properties = options_properties<SheetMaterial>();
  properties.update(options_properties<SolidMaterial>());
  properties.update(options_properties<SurfaceMaterial>());
  for (auto& [name, schema] : properties.items()) schema.erase("default");
  return properties;
}

}  // namespace

SchemaJson gravity_schema() {
  SchemaJson properties = options_properties<Gravity>();
  properties["enabled"] = enabled_schema();
  return {{"anyOf", {schema_reference("vector"), {{"type", "null"}}, object_schema(std::move(properties))}},
          {"description", "[m/s²]; null: none"}};
}

SchemaJson body_material_schema() {
  const SchemaJson name = text_schema("of a material: `pliant materials` lists them");
  SchemaJson properties = {{"name", name}};
  properties.update(options_properties<MaterialPlacement>());
  properties.update(material_numbers());
  return {{"anyOf", {name, object_schema(std::move(properties), {"name"})}}};
}

SchemaJson materials_schema() {
  SchemaJson properties = {{"like", text_schema("name of a material whose numbers it has, but those given here")},
                           {"kind", choice_schema(std::array<std::string_view, 2>{"sheet", "solid"})},
                           {"description", text_schema("one line")},
                           {"source", text_schema("where the numbers come from")}};
  properties.update(material_numbers());
  SchemaJson material = object_schema(std::move(properties));
  material["oneOf"] = {{{"required", {"like"}}}, {{"required", {"kind"}}}};
  return {{"type", "object"}, {"additionalProperties", std::move(material)}};
}

SchemaJson solid_schema() {
  SchemaJson properties = options_properties<LatticeOptions>();
  properties["spacing"].erase("default");
  SchemaJson schema = object_schema(std::move(properties), {"spacing"});
  schema["description"] = "fills the closed surface of the mesh with tetrahedra that carry it";
  return schema;
}

SchemaJson part_definitions() {
  const SchemaJson count = {{"type", "integer"}, {"minimum", 1}, {"maximum", 10000}};
  const SchemaJson part = {{"name", text_schema("of the group of its vertices")},
                           {"transform", schema_reference("transform")},
                           {"copies", object_schema({{"count", count}, {"offset", schema_reference("vector")}})}};
  return {{"mesh", mesh_choices()},
          {"mesh_part", closed_reference("mesh", part)},
          {"constraint", {{"oneOf", constraint_choices(static_cast<BuiltinConstraints*>(nullptr))}}},
          {"attachment", attachment_schema()},
          {"force", {{"oneOf", force_choices()}}},
          {"contact", object_schema(options_properties<ContactSettings>())},
          {"body_contact", body_contact_schema()},
          {"animation", animation_schema()},
          {"solid", solid_schema()},
          {"collider", {{"oneOf", collider_choices()}}}};
}

SchemaJson event_definitions() {
  SchemaJson when = open_object_schema(options_properties<EventTime>());
  for (const char* name : {"step", "time"}) when["properties"][name].erase("default");
  when.update(one_of_keys({"step", "time"}));
  SchemaJson move = open_object_schema(options_properties<MoveOptions>());
  move.update(one_of_keys({"target", "offset", "rotate", "keyframes"}));

  const SchemaJson name = text_schema("name of a group, a force or a collider");
  const SchemaJson group = schema_reference("moved_group");
  const SchemaJson index = {{"index", value_schema(OptionInfo{}, ConstraintNumbers{})}};
  const SchemaJson gravity = {{"anyOf", {schema_reference("vector"), {{"type", "null"}}}}};
  SchemaJson release = timed_schema("release", group, joined(index, {{"vertices", schema_reference("selection")}}));
  release["allOf"].push_back(one_of_keys({"vertices", "index"}));
  return {{"when", std::move(when)},
          {"moved_group", text_schema("name of a group of positions or drags, or of a collider")},
          {"move", std::move(move)},
          {"timed_move", timed_move_schema("group")},
          {"event",
           {{"oneOf",
             {change_schema(), timed_schema("settings", schema_reference("settings")),
              timed_schema("contact", schema_reference("contact")), body_contact_event_schema(),
              timed_schema("gravity", gravity), timed_schema("add", add_schema()), timed_schema("remove", name),
              std::move(release), timed_move_schema("move"), follow_schema(), timed_schema("stop", group, index)}}}}};
}

}  // namespace pliant
