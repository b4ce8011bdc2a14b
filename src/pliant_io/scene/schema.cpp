#include "pliant_io/scene/schema.h"

#include "pliant_io/scene/detail/json_values.h"
#include "pliant_io/scene/detail/schema_parts.h"
#include "pliant_io/scene/scene.h"

namespace pliant {
namespace {

SchemaJson definitions() {
  const SchemaJson coordinate = {{"type", "number"}, {"minimum", -max_coordinate}, {"maximum", max_coordinate}};
  const SchemaJson share = {{"type", "number"}, {"minimum", 0}, {"maximum", 1}};
  const SchemaJson vertex = {{"type", "integer"}, {"minimum", 0}};
  SchemaJson vertices = list_schema(vertex);
  vertices["minItems"] = 1;
  SchemaJson stencils = list_schema({{"anyOf", {vertex, vertices}}});
  stencils["minItems"] = 1;
  SchemaJson points = list_schema(schema_reference("vector"));
  points["minItems"] = 1;

  const SchemaJson selection = schema_reference("selection");
  const SchemaJson selections = {{"type", "array"}, {"items", selection}, {"minItems", 1}};
  const SchemaJson vector = schema_reference("vector");
  SchemaJson by_map = object_schema(
      {{"map", schema_reference("map")}, {"above", {{"type", "number"}}}, {"below", {{"type", "number"}}}}, {"map"});
  by_map["minProperties"] = 2;
  const auto only = [](const char* key, SchemaJson value) { return object_schema({{key, std::move(value)}}, {key}); };
  return {
      {"vector", list_schema(coordinate, 3)},
      {"points", {{"anyOf", {vector, std::move(points)}}}},
      {"color", {{"anyOf", {{{"type", "string"}, {"pattern", "^#[0-9a-fA-F]{6}$"}}, list_schema(share, 3)}}}},
      {"stencils", std::move(stencils)},
      {"map",
       {{"oneOf",
         {only("name", text_schema("of a map of the mesh's file")),
          only("file", text_schema("path of a file with one number for each vertex"))}}}},
      {"mapped_values", object_schema({{"map", schema_reference("map")},
                                       {"from", {{"type", "number"}, {"description", "the value where the map has 0"}}},
                                       {"to", {{"type", "number"}, {"description", "the value where the map has 1"}}}},
                                      {"map"})},
      {"selection",
       {{"anyOf",
         {choice_schema(std::array<std::string_view, 3>{"all", "boundary", "corners"}), vertices,
          only("box", object_schema({{"min", vector}, {"max", vector}}, {"min", "max"})),
          only("half_space", object_schema({{"point", vector}, {"normal", vector}}, {"point", "normal"})),
          only("nearest", schema_reference("points")),
          only("boundary_loop", {{"anyOf", {vertex, only("nearest", vector)}}}),
          only("group", text_schema("of the mesh's file: a group, an object or a material")), std::move(by_map),
          only("any_of", selections), only("all_of", selections), only("not", selection)}}}},
  };
}

SchemaJson transform_schema() {
  const SchemaJson factor = number_schema("number", positive);
  return object_schema(
      {{"scale", {{"anyOf", {factor, list_schema(factor, 3)}}}},
       {"rotate",
        object_schema({{"axis", schema_reference("vector")}, {"degrees", {{"type", "number"}}}}, {"axis", "degrees"})},
       {"translate", schema_reference("vector")}});
}

SchemaJson all_definitions() {
  SchemaJson all = definitions();
  all["transform"] = described(transform_schema(), "of the rest positions: scaled, then turned, then moved");
  all["settings"] = object_schema(options_properties<SolverSettings>());
  all["body_material"] = body_material_schema();
  all.update(part_definitions());
  all.update(event_definitions());
  return all;
}

/// Text of JSON in which what fits into a line stands in one.
std::string short_text(const SchemaJson& json, const std::string& indent = "") {
  constexpr std::size_t width = 120;
  const std::string line = json.dump();
  if (!json.is_structured() || indent.size() + line.size() <= width) return line;
  const std::string inner = indent + ' ';
  std::string text;
  for (const auto& [key, value] : json.items()) {
    text += (text.empty() ? "\n" : ",\n") + inner;
    if (json.is_object()) text += SchemaJson(key).dump() + ": ";
    text += short_text(value, inner);
  }
  return json.is_object() ? "{" + text + '\n' + indent + '}' : "[" + text + '\n' + indent + ']';
}

SchemaJson factors_schema() {
  const SchemaJson values = {
      {"anyOf", {list_schema(number_schema("number", positive)), schema_reference("mapped_values")}}};
  return {{"type", "object"},
          {"additionalProperties", values},
          {"description", "by the names of groups: what their stiffness is multiplied by at each vertex"}};
}

SchemaJson body_schema() {
  SchemaJson schema = object_schema({{"name", text_schema("what others refer to it by; default \"body 0\", ...")},
                                     {"mesh", mesh_schema()},
                                     {"transform", schema_reference("transform")},
                                     {"mass", mass_schema()},
                                     {"material", schema_reference("body_material")},
                                     {"start_positions", list_schema(schema_reference("vector"))},
                                     {"velocity", schema_reference("vector")},
                                     {"velocities", list_schema(schema_reference("vector"))},
                                     {"constraints", list_schema(constraint_schema())},
                                     {"contact", schema_reference("body_contact")},
                                     {"animation", schema_reference("animation")},
                                     {"solid", schema_reference("solid")},
                                     {"appearance", object_schema(options_properties<BodyAppearance>())},
                                     {"stiffness_factors", factors_schema()},
                                     {"disabled_groups", described(list_schema(SchemaJson{{"type", "string"}}),
                                                                   "of its material, which are switched off")}},
                                    {"mesh"});
  schema["anyOf"] = {{{"required", {"mass"}}}, {{"required", {"material"}}}, {{"required", {"animation"}}}};
  return schema;
}

SchemaJson include_schema() {
  const SchemaJson path = text_schema("path of a scene, from the folder of this one, or the name of a built-in scene");
  const SchemaJson one = {
      {"anyOf",
       {path,
        object_schema({{"file", path},
                       {"set", {{"type", "object"}, {"description", "values by their paths, as --set takes them"}}}},
                      {"file"})}}};
  return {{"anyOf", {one, list_schema(one)}}};
}

SchemaJson root_properties() {
  const Scene defaults;
  return {{"$schema", text_schema("for editors; not read")},
          {"pliant", {{"const", 1}, {"description", "version of this format"}}},
          {"name", text_schema("default: the file's name")},
          {"description", text_schema("one line")},
          {"include", described(include_schema(), "scenes that this one goes on from")},
          {"settings", schema_reference("settings")},
          {"steps", {{"type", "integer"}, {"minimum", 0}, {"default", defaults.steps}}},
          {"gravity", gravity_schema()},
          {"materials", described(materials_schema(), "of one's own, by name")},
          {"bodies", list_schema(body_schema())},
          {"attachments",
           list_schema(described(SchemaJson{{"$ref", "#/$defs/attachment"}, {"unevaluatedProperties", false}},
                                 "what ties bodies to each other"))},
          {"forces", list_schema(schema_reference("force"))},
          {"contact", schema_reference("contact")},
          {"colliders", list_schema(schema_reference("collider"))},
          {"moves", list_schema(schema_reference("timed_move"))},
          {"events", list_schema(schema_reference("event"))},
          {"output", object_schema(options_properties<OutputSettings>())},
          {"view", object_schema(options_properties<ViewSettings>())}};
}

}  // namespace

std::string scene_schema() {
  SchemaJson schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                       {"title", "Pliant scene"},
                       {"description", "What to simulate with Pliant; docs/scenes.md says what it means."}};
  schema.update(object_schema(root_properties(), {"pliant"}));
  schema["anyOf"] = {{{"required", {"bodies"}}}, {{"required", {"include"}}}};
  schema["$defs"] = all_definitions();
  return short_text(schema) + '\n';
}

}  // namespace pliant
