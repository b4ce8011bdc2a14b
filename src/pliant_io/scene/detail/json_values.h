#pragma once
// The kinds of values that scene files hold, one overload of `read` each. All throw Error(input) with the place of the
// first value of a wrong type. The parser lets no number through that is not finite.
#include <array>

#include <fmt/format.h>

#include "pliant/core/options.h"
#include "pliant/core/types.h"
#include "pliant_io/scene/detail/json_node.h"
#include "pliant_io/scene/nearest_names.h"
#include "pliant_io/scene/view_settings.h"

namespace pliant {

/// Larger coordinates overflow once they are squared, or multiplied with each other a few times.
inline constexpr Real max_coordinate = 1e100;

void read(const Node& node, Real& number);
void read(const Node& node, Index& number);
void read(const Node& node, std::int64_t& number);
/// true or false.
void read(const Node& node, bool& flag);
void read(const Node& node, std::string& text);
/// Three numbers; none beyond max_coordinate, here and below.
void read(const Node& node, Vec3& vector);
/// A list of lists of three numbers.
void read(const Node& node, Positions& rows);
void read(const Node& node, std::vector<Real>& numbers);
/// A number, or a list of numbers.
void read(const Node& node, Values& values);
/// A list of three numbers, or a list of such lists.
void read(const Node& node, Points& points);
void read(const Node& node, Ragged<Real>& lists);

/// "#rrggbb", or a list of three numbers from 0 to 1.
void read(const Node& node, Color& color);

/// Refuses a number out of its range, where it stands in the value or in a list of that.
void check_range(const Node& value, const OptionInfo& info);

/// A vertex index from 0 to vertex_count − 1.
Index read_vertex(const Node& node, Index vertex_count);
/// A list of such.
std::vector<Index> read_vertices(const Node& node, Index vertex_count);
/// A list of lists of vertex indices; a single index stands for a list of one.
Stencils read_stencils(const Node& node, Index vertex_count);

template <class Element, std::size_t n>
void read(const Node& node, std::array<Element, n>& elements) {
  node.require_list(n, "numbers");
  for (std::size_t i = 0; i < n; ++i) read(node[i], elements[i]);
}

/// A list of elements of n vertices.
template <std::size_t n>
std::vector<std::array<Index, n>> read_elements(const Node& node, Index vertex_count) {
  node.require_list();
  std::vector<std::array<Index, n>> elements(node.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Node element = node[i];
    element.require_list(n, "vertex indices");
    for (std::size_t j = 0; j < n; ++j) elements[i][j] = read_vertex(element[j], vertex_count);
  }
  return elements;
}

/// One of the names of an enumeration.
template <class Choice>
requires std::is_enum_v<Choice>
void read(const Node& node, Choice& choice) {
  constexpr auto names = choice_names(Choice{});
  std::string name;
  read(node, name);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) {
      choice = static_cast<Choice>(i);
      return;
    }
  }
  node.fail(
      fmt::format("unknown choice '{}'; {}", printable(name), suggestion_text(name, {names.begin(), names.end()})));
}

template <class Value>
void read(const Node& node, std::optional<Value>& value) {
  read(node, value.emplace());
}

/// Reads the value of a key into `value`, or leaves it as it is when the key is not there.
template <class Value>
void read_optional(const Node& object, std::string_view key, Value& value) {
  if (const std::optional<Node> node = object.find(key)) read(*node, value);
}

}  // namespace pliant
