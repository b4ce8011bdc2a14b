#pragma once
// Options as JSON, as scene files have them.
#include <array>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "pliant/simulation/parameters.h"
#include "pliant_io/scene/view_settings.h"
#include "viewer/rounding.h"

namespace pliant_viewer {

using Json = nlohmann::ordered_json;

template <class Options>
concept lists_options = requires(const Options options) {
  Options::visit(options, [](const pliant::OptionInfo&, const auto&) {});
};

inline Json json_of(const pliant::Vec3& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

inline Json json_of(const pliant::Color& color) {
  return {without_single_precision(color.red), without_single_precision(color.green),
          without_single_precision(color.blue)};
}

inline Json json_of(const std::string& text) {
  return text;
}

template <class Number>
requires std::is_arithmetic_v<Number> Json json_of(Number number) {
  return number;
}

template <class Choice>
requires std::is_enum_v<Choice> Json json_of(Choice choice) {
  return choice_names(choice)[static_cast<std::size_t>(choice)];
}

template <class Number, std::size_t n>
Json json_of(const std::array<Number, n>& numbers) {
  return numbers;
}

template <lists_options Options>
Json json_of(const Options& options);

/// A point for all, or a list with one each; null for none.
inline Json json_of(const pliant::Points& points) {
  if (points.empty()) return {};
  if (!points.each()) return json_of(points[0]);
  Json list = Json::array();
  for (const pliant::Vec3& point : points.list()) list.push_back(json_of(point));
  return list;
}

template <class Value>
Json json_of(const std::optional<Value>& value) {
  return value ? json_of(*value) : Json();
}

template <class Value>
Json json_of(const std::vector<Value>& values);

/// Of each option its name and value; null for none.
template <lists_options Options>
Json all_options(const Options& options) {
  Json json = Json::object();
  Options::visit(options, [&](const pliant::OptionInfo& info, const auto& value) {
    json[std::string(info.name)] = json_of(value);
  });
  return json;
}

/// Entries of a list say all, lest they leave out what must be given.
template <class Value>
Json json_of(const std::vector<Value>& values) {
  Json list = Json::array();
  for (const Value& value : values) {
    if constexpr (lists_options<Value>) {
      Json given = Json::object();
      Value::visit(value, [&given](const pliant::OptionInfo& info, const auto& option) {
        Json json = json_of(option);
        if (!json.is_null()) given[std::string(info.name)] = std::move(json);
      });
      list.push_back(std::move(given));
    } else {
      list.push_back(json_of(value));
    }
  }
  return list;
}

/// Those that differ from the defaults.
template <lists_options Options>
Json json_of(const Options& options) {
  Json json = all_options(options);
  const Json usual = all_options(Options{});
  for (const auto& [name, value] : usual.items()) {
    if (json.at(name) == value) json.erase(name);
  }
  return json;
}

/// The value of a parameter, of which the first number counts unless it is a vector.
inline Json value_json(const pliant::Parameter& parameter, const pliant::Vec3& value) {
  switch (parameter.kind) {
    case pliant::ParameterKind::real:
      return value[0];
    case pliant::ParameterKind::integer:
      return static_cast<std::int64_t>(value[0]);
    case pliant::ParameterKind::choice:
      return parameter.choices.at(static_cast<std::size_t>(value[0]));
    case pliant::ParameterKind::flag:
      return value[0] != 0;
    case pliant::ParameterKind::vector:
      return json_of(value);
  }
  return {};
}

}  // namespace pliant_viewer
