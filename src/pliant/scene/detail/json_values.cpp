#include "pliant/scene/detail/json_values.h"

#include <algorithm>
#include <limits>

namespace pliant {
namespace {

// Long lists are read through their values; a Node, with its path, is only made for a message.

Real to_real(const Json& value, auto&& place) {
  if (!value.is_number()) place().fail_type("a number");
  return value.get<Real>();
}

std::int64_t to_integer(const Json& value, auto&& place) {
  constexpr auto largest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  if (!value.is_number()) place().fail_type("a whole number");
  if (!value.is_number_integer() || (value.is_number_unsigned() && value.get<std::uint64_t>() > largest)) {
    place().fail(fmt::format("a whole number is wanted here, not {}; leave out point and exponent", value.dump()));
  }
  return value.get<std::int64_t>();
}

Index to_index(const Json& value, auto&& place) {
  const std::int64_t number = to_integer(value, place);
  constexpr std::int64_t largest = std::numeric_limits<Index>::max();
  if (number < -largest || number > largest) {
    place().fail(fmt::format("{} is out of range; whole numbers go up to {} here", number, largest));
  }
  return static_cast<Index>(number);
}

Index to_vertex(const Json& value, Index vertex_count, auto&& place) {
  const Index vertex = to_index(value, place);
  if (vertex < 0 || vertex >= vertex_count) {
    place().fail(fmt::format("vertex {} is out of range; the body has vertices 0 to {}", vertex, vertex_count - 1));
  }
  return vertex;
}

Vec3 to_vector(const Json& value, auto&& place) {
  if (!value.is_array() || value.size() != 3) place().require_list(3, "numbers");
  Vec3 vector;
  for (std::size_t i = 0; i < 3; ++i) {
    vector[static_cast<Index>(i)] = to_real(value[i], [&] { return place()[i]; });
  }
  return vector;
}

/// Calls f(entry, place of the entry) for each entry of a list.
void for_each(const Node& list, auto&& f) {
  list.require_list();
  for (std::size_t i = 0; i < list.value().size(); ++i) f(list.value()[i], [&] { return list[i]; });
}

bool is_list_of_lists(const Json& value) {
  return value.is_array() && !value.empty() && value.front().is_array();
}

void require_entries(const Node& list) {
  list.require_list();
  if (list.value().empty()) list.fail("the list is empty; fill it, or leave out the key");
}

}  // namespace

void read(const Node& node, Real& number) {
  number = to_real(node.value(), [&] { return node; });
}

void read(const Node& node, Index& number) {
  number = to_index(node.value(), [&] { return node; });
}

void read(const Node& node, std::int64_t& number) {
  number = to_integer(node.value(), [&] { return node; });
}

void read(const Node& node, std::string& text) {
  if (!node.value().is_string()) node.fail_type("a text");
  text = node.value().get<std::string>();
}

void read(const Node& node, Vec3& vector) {
  vector = to_vector(node.value(), [&] { return node; });
}

void read(const Node& node, Positions& rows) {
  node.require_list();
  rows.resize(static_cast<Eigen::Index>(node.value().size()), 3);
  Eigen::Index i = 0;
  for_each(node, [&](const Json& value, auto&& place) { rows.row(i++) = to_vector(value, place).transpose(); });
}

void read(const Node& node, std::vector<Real>& numbers) {
  numbers.clear();
  for_each(node, [&](const Json& value, auto&& place) { numbers.push_back(to_real(value, place)); });
}

void read(const Node& node, Values& values) {
  if (!node.value().is_array()) {
    values = to_real(node.value(), [&] { return node; });
    return;
  }
  require_entries(node);
  std::vector<Real> numbers;
  read(node, numbers);
  values = Values(std::move(numbers));
}

void read(const Node& node, Points& points) {
  require_entries(node);
  if (!is_list_of_lists(node.value())) {
    points = to_vector(node.value(), [&] { return node; });
    return;
  }
  std::vector<Vec3> list;
  for_each(node, [&](const Json& value, auto&& place) { list.push_back(to_vector(value, place)); });
  points = Points(std::move(list));
}

void read(const Node& node, Ragged<Real>& lists) {
  require_entries(node);
  lists = {};
  for_each(node, [&](const Json&, auto&& place) {
    std::vector<Real> numbers;
    read(place(), numbers);
    lists.add(numbers);
  });
}

Index read_vertex(const Node& node, Index vertex_count) {
  return to_vertex(node.value(), vertex_count, [&] { return node; });
}

std::vector<Index> read_vertices(const Node& node, Index vertex_count) {
  require_entries(node);
  std::vector<Index> vertices;
  for_each(node, [&](const Json& value, auto&& place) { vertices.push_back(to_vertex(value, vertex_count, place)); });
  return vertices;
}

Stencils read_stencils(const Node& node, Index vertex_count) {
  require_entries(node);
  Stencils stencils;
  for_each(node, [&](const Json& value, auto&& place) {
    if (!value.is_array()) {
      stencils.add({to_vertex(value, vertex_count, place)});
      return;
    }
    stencils.add(read_vertices(place(), vertex_count));
  });
  return stencils;
}

}  // namespace pliant
