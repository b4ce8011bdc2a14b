#include "pliant_io/scene/detail/json_values.h"

#include <charconv>
#include <cmath>
#include <limits>

namespace pliant {
namespace {

void read_coordinate(const Node& node, Real& number) {
  read(node, number);
  if (std::abs(number) > max_coordinate) {
    node.fail(
        fmt::format("{} is out of range; give a number from -{:g} to {:g}", number, max_coordinate, max_coordinate));
  }
}

/// Calls f for each entry of a list.
void for_each(const Node& list, auto&& f) {
  list.require_list();
  for (std::size_t i = 0; i < list.size(); ++i) f(list[i]);
}

void require_entries(const Node& list) {
  list.require_list();
  if (list.empty()) list.fail("the list is empty; fill it, or leave out the key");
}

}  // namespace

void read(const Node& node, Real& number) {
  if (!node.is_number()) node.fail_type("a number");
  number = node.number();
}

void read(const Node& node, std::int64_t& number) {
  if (!node.is_number()) node.fail_type("a whole number");
  if (!node.is_integer()) {
    constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();
    if (std::abs(node.number()) >= 0x1p63) {
      node.fail(fmt::format("found {}; give a whole number up to {}", node.number(), largest));
    }
    node.fail(fmt::format("found {}; give a whole number, without point and exponent", node.number()));
  }
  number = node.integer();
}

void read(const Node& node, Index& number) {
  std::int64_t wide = 0;
  read(node, wide);
  constexpr std::int64_t largest = std::numeric_limits<Index>::max();
  if (wide < -largest || wide > largest) {
    node.fail(fmt::format("{} is out of range; whole numbers go up to {} here", wide, largest));
  }
  number = static_cast<Index>(wide);
}

void read(const Node& node, bool& flag) {
  if (!node.is_boolean()) node.fail_type("true or false");
  flag = node.boolean();
}

void read(const Node& node, std::string& text) {
  if (!node.is_text()) node.fail_type("a text");
  text = node.text();
}

void read(const Node& node, Vec3& vector) {
  node.require_list(3, "numbers");
  for (std::size_t i = 0; i < 3; ++i) read_coordinate(node[i], vector[static_cast<Index>(i)]);
}

void read(const Node& node, Positions& rows) {
  node.require_list();
  rows.resize(static_cast<Eigen::Index>(node.size()), 3);
  Eigen::Index i = 0;
  for_each(node, [&](const Node& entry) {
    Vec3 point;
    read(entry, point);
    rows.row(i++) = point.transpose();
  });
}

void read(const Node& node, std::vector<Real>& numbers) {
  numbers.clear();
  numbers.reserve(node.size());
  for_each(node, [&](const Node& entry) { read(entry, numbers.emplace_back()); });
}

void read(const Node& node, Values& values) {
  if (!node.is_list()) {
    Real number = 0;
    read(node, number);
    values = number;
    return;
  }
  require_entries(node);
  std::vector<Real> numbers;
  read(node, numbers);
  values = Values(std::move(numbers));
}

void read(const Node& node, Points& points) {
  require_entries(node);
  if (!node[0].is_list()) {
    Vec3 point;
    read(node, point);
    points = point;
    return;
  }
  std::vector<Vec3> list;
  list.reserve(node.size());
  for_each(node, [&](const Node& entry) { read(entry, list.emplace_back()); });
  points = Points(std::move(list));
}

void read(const Node& node, Ragged<Real>& lists) {
  require_entries(node);
  lists = {};
  lists.offsets.reserve(node.size() + 1);
  std::vector<Real> numbers;
  for_each(node, [&](const Node& entry) {
    read(entry, numbers);
    lists.add(numbers);
  });
}

void read(const Node& node, Color& color) {
  constexpr std::string_view wanted = "is not a color; give \"#rrggbb\", or three numbers from 0 to 1";
  const std::array<Real*, 3> parts = {&color.red, &color.green, &color.blue};
  if (node.is_list()) {
    node.require_list(3, "numbers from 0 to 1");
    for (std::size_t i = 0; i < 3; ++i) {
      read(node[i], *parts[i]);
      if (!(*parts[i] >= 0 && *parts[i] <= 1)) node[i].fail(wanted);
    }
    return;
  }
  if (!node.is_text()) node.fail(wanted);
  const std::string_view text = node.text();
  constexpr std::string_view digits = "0123456789abcdefABCDEF";
  if (text.size() != 7 || text[0] != '#' || text.find_first_not_of(digits, 1) != text.npos) node.fail(wanted);
  for (std::size_t i = 0; i < 3; ++i) {
    int value = 0;
    std::from_chars(&text[1 + 2 * i], &text[1 + 2 * i] + 2, value, 16);
    *parts[i] = value / 255.0;
  }
}

void check_range(const Node& value, const OptionInfo& info) {
  if (value.is_number()) {
    const bool is_of_word = !info.word.empty() && value.number() == info.number_of_word;  // which must be written
    OptionInfo known = info;
    if (is_of_word) known.word = {};
    if (const auto error = range_error(known, value.number())) value.fail(*error);
  } else if (value.is_list()) {
    for (std::size_t i = 0; i < value.size(); ++i) check_range(value[i], info);
  }
}

Index read_vertex(const Node& node, Index vertex_count) {
  Index vertex = 0;
  read(node, vertex);
  if (vertex < 0 || vertex >= vertex_count) {
    node.fail(fmt::format("vertex {} is out of range; the body has vertices 0 to {}", vertex, vertex_count - 1));
  }
  return vertex;
}

std::vector<Index> read_vertices(const Node& node, Index vertex_count) {
  require_entries(node);
  std::vector<Index> vertices;
  vertices.reserve(node.size());
  for_each(node, [&](const Node& entry) { vertices.push_back(read_vertex(entry, vertex_count)); });
  return vertices;
}

Stencils read_stencils(const Node& node, Index vertex_count) {
  require_entries(node);
  Stencils stencils;
  stencils.offsets.reserve(node.size() + 1);
  stencils.values.reserve(node.size());
  for_each(node, [&](const Node& entry) {
    if (entry.is_list()) {
      stencils.add(read_vertices(entry, vertex_count));
    } else {
      stencils.add({read_vertex(entry, vertex_count)});
    }
  });
  return stencils;
}

}  // namespace pliant
