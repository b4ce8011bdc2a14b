#include "pliant/scene/detail/schema_parts.h"

#include "pliant/constraints/builtin.h"
#include "pliant/forces/mouse_spring.h"
#include "pliant/forces/wind.h"
#include "pliant/mesh/io/mesh_file.h"
#include "pliant/scene/detail/shape_options.h"

namespace pliant {
namespace {

SchemaJson text(std::string_view description) {
  return {{"type", "string"}, {"description", description}};
}

SchemaJson vertex_schema() {
  return {{"type", "integer"}, {"minimum", 0}};
}

template <class Shape>
SchemaJson shape_schema() {
  SchemaJson properties = {{"shape", {{"const", Shape::name}}}};
  Shape{}.visit(SchemaVisitor{properties});
  return object_schema(std::move(properties), {"shape"});
}

template <class... Shape>
void add_shapes(SchemaJson& choices, std::tuple<Shape...>*) {
  (choices.push_back(shape_schema<Shape>()), ...);
}

template <class Constraint>
SchemaJson constraint_type_schema() {
  SchemaJson properties = {{"type", {{"const", Constraint::info.name}}}, {"name", text("what others refer to it by")}};
  properties.update(options_properties<Constraint>());
  SchemaJson schema = object_schema(std::move(properties), {"type"});
  schema["description"] = std::string(Constraint::info.energy);
  return schema;
}

template <class... Constraint>
void add_constraints(SchemaJson& choices, std::tuple<Constraint...>*) {
  (choices.push_back(constraint_type_schema<Constraint>()), ...);
}

SchemaJson force_type_schema(std::string_view type, SchemaJson properties, std::vector<std::string_view> required) {
  SchemaJson all = {{"type", {{"const", type}}}, {"body", text("name of the body; default: the only one")}};
  all.update(properties);
  required.push_back("type");
  return object_schema(std::move(all), std::move(required));
}

}  // namespace

SchemaJson mesh_schema() {
  SchemaJson file = {{"file", text("path of a mesh file, from the folder of the scene")}};
  file.update(options_properties<ImportOptions>());
  SchemaJson lists = {{"vertices", list_schema(schema_reference("vector"))},
                      {"edges", list_schema(list_schema(vertex_schema(), 2))},
                      {"triangles", list_schema(list_schema(vertex_schema(), 3))},
                      {"tetrahedra", list_schema(list_schema(vertex_schema(), 4))}};
  SchemaJson choices = {object_schema(std::move(file), {"file"}), object_schema(std::move(lists), {"vertices"})};
  add_shapes(choices, static_cast<Shapes*>(nullptr));
  return {{"oneOf", std::move(choices)}};
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
  schema["minProperties"] = schema["maxProperties"] = 1;
  return schema;
}

SchemaJson constraint_schema() {
  SchemaJson choices = SchemaJson::array();
  add_constraints(choices, static_cast<BuiltinConstraints*>(nullptr));
  return {{"oneOf", std::move(choices)}};
}

SchemaJson force_schema() {
  const SchemaJson vertex = {{"vertex", vertex_schema()}};
  SchemaJson mouse = options_properties<MouseSpringOptions>();
  mouse.update(vertex);
  SchemaJson test = {{"vertex", vertex_schema()},
                     {"vertices", schema_reference("selection")},
                     {"force", schema_reference("points")},
                     {"frames", list_schema({{"type", "integer"}}, 2)}};
  SchemaJson test_force = force_type_schema("test_force", std::move(test), {"force"});
  test_force["oneOf"] = {{{"required", {"vertex"}}}, {{"required", {"vertices"}}}};
  return {{"oneOf",
           {force_type_schema("wind", options_properties<WindOptions>(), {}), std::move(test_force),
            force_type_schema("mouse_spring", std::move(mouse), {"anchor", "vertex"})}}};
}

SchemaJson move_schema() {
  SchemaJson properties = {{"group", text("name of a group of positions or drags")},
                           {"step", {{"type", "integer"}, {"minimum", 0}}},
                           {"time", {{"type", "number"}, {"minimum", 0}, {"description", "[s]"}}},
                           {"index", vertex_schema()},
                           {"target", schema_reference("points")},
                           {"offset", schema_reference("points")},
                           {"over", {{"type", "number"}, {"minimum", 0}, {"description", "[s]"}}}};
  SchemaJson schema = object_schema(std::move(properties), {"group"});
  const auto one_of = [](const char* a, const char* b) {
    return SchemaJson{{"oneOf", {{{"required", {a}}}, {{"required", {b}}}}}};
  };
  schema["allOf"] = {one_of("step", "time"), one_of("target", "offset")};
  return schema;
}

SchemaJson event_schema() {
  return {{"type", "object"}};
}

}  // namespace pliant
