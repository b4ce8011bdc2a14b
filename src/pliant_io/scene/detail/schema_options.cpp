#include "pliant_io/scene/detail/schema_options.h"

namespace pliant {

SchemaJson open_object_schema(SchemaJson properties, std::vector<std::string_view> required) {
  SchemaJson schema = {{"type", "object"}, {"properties", std::move(properties)}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

SchemaJson object_schema(SchemaJson properties, std::vector<std::string_view> required) {
  SchemaJson schema = open_object_schema(std::move(properties), std::move(required));
  schema["additionalProperties"] = false;
  return schema;
}

SchemaJson list_schema(SchemaJson entries, std::size_t n) {
  SchemaJson schema = {{"type", "array"}, {"items", std::move(entries)}};
  if (n > 0) schema["minItems"] = schema["maxItems"] = n;
  return schema;
}

SchemaJson number_schema(std::string_view type, const Range& range) {
  const auto number = [&](Real limit) {
    return type == "integer" ? SchemaJson(static_cast<std::int64_t>(limit)) : SchemaJson(limit);
  };
  SchemaJson schema = {{"type", type}};
  if (range.min > any_number.min) schema[range.excludes_min ? "exclusiveMinimum" : "minimum"] = number(range.min);
  if (range.max < any_number.max) schema["maximum"] = number(range.max);
  return schema;
}

SchemaJson choice_schema(std::span<const std::string_view> names) {
  SchemaJson list = SchemaJson::array();
  for (const std::string_view name : names) list.push_back(name);
  return {{"enum", std::move(list)}};
}

SchemaJson value_schema(const OptionInfo& info, const Index&) {
  const SchemaJson number = number_schema("integer", info.range);
  if (info.word.empty()) return number;
  return {{"anyOf", {number, {{"const", info.word}}}}};
}

SchemaJson value_schema(const OptionInfo& info, const Values&) {
  SchemaJson list = list_schema(number_schema("number", info.range));
  list["minItems"] = 1;
  return {{"anyOf", {number_schema("number", info.range), std::move(list), schema_reference("mapped_values")}}};
}

SchemaJson value_schema(const OptionInfo&, const std::vector<Index>&) {
  const SchemaJson number = {{"type", "integer"}, {"minimum", 0}};
  return {{"anyOf", {number, list_schema(number)}}};
}

}  // namespace pliant
