#pragma once
// What Python's annotations call the types of options.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "pliant/simulation/simulation.h"

namespace pliant_python {

template <class Value>
std::string annotation(const pliant::OptionInfo& info, const Value&);
inline std::string annotation(const pliant::OptionInfo&, const pliant::Real&) {
  return "float";
}
inline std::string annotation(const pliant::OptionInfo& info, const pliant::Index&) {
  return info.word.empty() ? "int" : "int | Literal[\"" + std::string(info.word) + "\"]";
}
inline std::string annotation(const pliant::OptionInfo&, const std::int64_t&) {
  return "int";
}
inline std::string annotation(const pliant::OptionInfo&, const bool&) {
  return "bool";
}
inline std::string annotation(const pliant::OptionInfo&, const std::string&) {
  return "str";
}
inline std::string annotation(const pliant::OptionInfo&, const pliant::Vec3&) {
  return "Vector";
}
inline std::string annotation(const pliant::OptionInfo&, const pliant::Values&) {
  return "Values";
}
inline std::string annotation(const pliant::OptionInfo&, const pliant::Points&) {
  return "Points";
}
inline std::string annotation(const pliant::OptionInfo&, const pliant::Ragged<pliant::Real>&) {
  return "Lists";
}
inline std::string annotation(const pliant::OptionInfo&, const pliant::Stencils&) {
  return "Stencils";
}
inline std::string annotation(const pliant::OptionInfo&, const pliant::Selection&) {
  return "Selection";
}
inline std::string annotation(const pliant::OptionInfo&, const pliant::BodyId&) {
  return "BodyId";
}
inline std::string annotation(const pliant::OptionInfo&, const std::vector<pliant::BodyId>&) {
  return "Sequence[BodyId]";
}
template <class Number, std::size_t n>
std::string annotation(const pliant::OptionInfo&, const std::array<Number, n>&) {
  return std::is_integral_v<Number> ? "Sequence[int]" : "Sequence[float]";
}
template <class Value>
std::string annotation(const pliant::OptionInfo& info, const std::optional<Value>&) {
  return annotation(info, Value{}) + " | None";
}
template <class Value>
std::string annotation(const pliant::OptionInfo&, const Value&) {
  static_assert(std::is_enum_v<Value>);
  std::string text;
  for (const std::string_view name : choice_names(Value{})) {
    text += (text.empty() ? "Literal[\"" : ", \"") + std::string(name) + "\"";
  }
  return text + "]";
}

}  // namespace pliant_python
