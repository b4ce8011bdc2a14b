#pragma once
// What the schema says of options, written once over the list that every type makes of its options.
#include <array>
#include <optional>
#include <type_traits>

#include <nlohmann/json.hpp>

#include "pliant/core/options.h"
#include "pliant_io/scene/view_settings.h"

namespace pliant {

using SchemaJson = nlohmann::ordered_json;

inline SchemaJson schema_reference(std::string_view definition) {
  return {{"$ref", "#/$defs/" + std::string(definition)}};
}

inline SchemaJson described(SchemaJson schema, std::string_view description) {
  schema["description"] = description;
  return schema;
}

/// An object of which these keys are known; what refers to it says whether there may be others.
SchemaJson open_object_schema(SchemaJson properties, std::vector<std::string_view> required = {});

/// An object without other keys than these.
SchemaJson object_schema(SchemaJson properties, std::vector<std::string_view> required = {});

/// A list; n > 0: of so many entries.
SchemaJson list_schema(SchemaJson entries, std::size_t n = 0);

/// A number, or a whole number, in a range.
SchemaJson number_schema(std::string_view type, const Range& range);

SchemaJson choice_schema(std::span<const std::string_view> names);

/// The value itself is only looked at for its type, and for a default where `properties` has a use for one.
inline SchemaJson value_schema(const OptionInfo& info, const Real&) {
  return number_schema("number", info.range);
}
SchemaJson value_schema(const OptionInfo& info, const Index&);
inline SchemaJson value_schema(const OptionInfo& info, const std::int64_t&) {
  return number_schema("integer", info.range);
}
inline SchemaJson value_schema(const OptionInfo&, const bool&) {
  return {{"type", "boolean"}};
}
inline SchemaJson value_schema(const OptionInfo&, const std::string&) {
  return {{"type", "string"}};
}
inline SchemaJson value_schema(const OptionInfo&, const Vec3&) {
  return schema_reference("vector");
}
inline SchemaJson value_schema(const OptionInfo&, const Color&) {
  return schema_reference("color");
}
inline SchemaJson value_schema(const OptionInfo&, const Points&) {
  return schema_reference("points");
}
inline SchemaJson value_schema(const OptionInfo&, const Stencils&) {
  return schema_reference("stencils");
}
inline SchemaJson value_schema(const OptionInfo&, const Selection&) {
  return schema_reference("selection");
}
inline SchemaJson value_schema(const OptionInfo& info, const Ragged<Real>&) {
  return list_schema(list_schema(number_schema("number", info.range)));
}
SchemaJson value_schema(const OptionInfo& info, const Values&);
/// Numbers from 0 up: one, or a list.
SchemaJson value_schema(const OptionInfo& info, const std::vector<Index>&);

template <class Value>
SchemaJson value_schema(const OptionInfo& info, const std::optional<Value>&);
template <class Value>
SchemaJson value_schema(const OptionInfo& info, const std::vector<Value>&);
template <class Number, std::size_t n>
SchemaJson value_schema(const OptionInfo& info, const std::array<Number, n>&);
template <class Value>
SchemaJson value_schema(const OptionInfo& info, const Value& value);

/// The default as JSON; null: there is none to be named.
template <class Value>
SchemaJson default_json(const Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    return std::string(choice_names(value)[static_cast<std::size_t>(value)]);
  } else if constexpr (std::is_arithmetic_v<Value> || std::is_same_v<Value, std::string>) {
    return value;
  } else if constexpr (std::is_same_v<Value, Vec3>) {
    return {value[0], value[1], value[2]};
  } else if constexpr (std::is_same_v<Value, Selection>) {
    return "all";
  } else if constexpr (std::is_same_v<Value, Values>) {
    return value.empty() ? SchemaJson() : SchemaJson(value[0]);
  } else if constexpr (std::is_same_v<Value, Color>) {
    return {value.red, value.green, value.blue};
  } else {
    return nullptr;
  }
}

template <class Number, std::size_t n>
SchemaJson default_json(const std::array<Number, n>& value) {
  return SchemaJson(value);
}

/// Text, unit and default of an option, to go with what its values are.
template <class Value>
SchemaJson option_schema(const OptionInfo& info, const Value& value) {
  SchemaJson schema = value_schema(info, value);
  std::string text(info.doc);
  if (!info.unit.empty()) text += (text.empty() ? "[" : " [") + std::string(info.unit) + "]";
  if (!text.empty()) schema["description"] = text;
  if (SchemaJson given = default_json(value); !given.is_null()) schema["default"] = std::move(given);
  return schema;
}

/// A visitor that adds each option to the properties of an object.
struct SchemaVisitor {
  SchemaJson& properties;

  template <class Value>
  void operator()(const OptionInfo& info, const Value& value) const {
    properties[std::string(info.name)] = option_schema(info, value);
  }
};

/// The properties of a type that lists its options.
template <class Options>
SchemaJson options_properties(const Options& options = {}) {
  SchemaJson properties = SchemaJson::object();
  Options::visit(options, SchemaVisitor{properties});
  return properties;
}

template <class Value>
SchemaJson value_schema(const OptionInfo& info, const std::optional<Value>&) {
  return value_schema(info, Value{});
}

template <class Value>
SchemaJson value_schema(const OptionInfo& info, const std::vector<Value>&) {
  return list_schema(value_schema(info, Value{}));
}

template <class Number, std::size_t n>
SchemaJson value_schema(const OptionInfo& info, const std::array<Number, n>&) {
  return list_schema(number_schema(std::is_integral_v<Number> ? "integer" : "number", info.range), n);
}

template <class Value>
SchemaJson value_schema(const OptionInfo&, const Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    constexpr auto names = choice_names(Value{});
    return choice_schema(names);
  } else {
    return object_schema(options_properties(value));
  }
}

}  // namespace pliant
