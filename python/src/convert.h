#pragma once
// Python's values to those of options and back, one overload of `read` and of `to_python` each.
#include <string>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "pliant/simulation/simulation.h"
#include "pliant_io/scene/nearest_names.h"

namespace pliant_python {

namespace py = pybind11;

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<pliant::Index, py::array::c_style | py::array::forcecast>;

/// What is being read, for messages and for what refers to a mesh.
struct Place {
  std::string_view owner;  ///< "EdgeSpring"
  const pliant::OptionInfo& info;
  const pliant::Mesh* mesh = nullptr;  ///< null: only what needs none is checked
};

/// Throws Error(input): "EdgeSpring: stiffness: found 'soft'; give a number [N/m]".
[[noreturn]] void fail_type(const Place& place, py::handle found, const std::string& wanted);
[[noreturn]] void fail(const Place& place, const std::string& what);

void read(const Place& place, py::handle given, pliant::Real& number);
void read(const Place& place, py::handle given, std::int64_t& number);
void read(const Place& place, py::handle given, pliant::Index& number);
void read(const Place& place, py::handle given, bool& flag);
void read(const Place& place, py::handle given, std::string& text);
void read(const Place& place, py::handle given, pliant::Vec3& vector);
void read(const Place& place, py::handle given, pliant::Values& values);
void read(const Place& place, py::handle given, pliant::Points& points);
void read(const Place& place, py::handle given, pliant::Ragged<pliant::Real>& lists);
void read(const Place& place, py::handle given, pliant::Stencils& stencils);
void read(const Place& place, py::handle given, pliant::Selection& selection);
void read(const Place& place, py::handle given, pliant::BodyId& body);
void read(const Place& place, py::handle given, std::vector<pliant::BodyId>& bodies);
/// Of an enumeration: the index of a name.
std::size_t read_choice(const Place& place, py::handle given, const std::vector<std::string_view>& names);

template <class Choice>
requires std::is_enum_v<Choice>
void read(const Place& place, py::handle given, Choice& choice) {
  constexpr auto names = choice_names(Choice{});
  choice = static_cast<Choice>(read_choice(place, given, {names.begin(), names.end()}));
}

template <class Number, std::size_t n>
void read(const Place& place, py::handle given, std::array<Number, n>& numbers) {
  const Numbers array = Numbers::ensure(given);
  if (!array || array.ndim() != 1 || array.size() != static_cast<py::ssize_t>(n)) {
    PyErr_Clear();
    fail_type(place, given, std::to_string(n) + " numbers");
  }
  py::ssize_t i = 0;
  for (Number& number : numbers) read(place, py::float_(array.at(i++)), number);
}

template <class Value>
void read(const Place& place, py::handle given, std::optional<Value>& value) {
  if (given.is_none()) return value.reset();
  read(place, given, value.emplace());
}

py::object to_python(const pliant::Vec3& vector);
py::object to_python(const pliant::Values& values);
py::object to_python(const pliant::Points& points);
py::object to_python(const pliant::Ragged<pliant::Real>& lists);
py::object to_python(const pliant::Stencils& stencils);
py::object to_python(const pliant::Selection& selection);
py::object to_python(pliant::BodyId body);
py::object to_python(const std::vector<pliant::BodyId>& bodies);

template <class Value>
py::object to_python(const Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    const std::string_view name = choice_names(Value{})[static_cast<std::size_t>(value)];
    return py::str(name.data(), name.size());
  } else {
    return py::cast(value);
  }
}
template <class Value>
py::object to_python(const std::optional<Value>& value) {
  return value ? to_python(*value) : py::none();
}
template <class Number, std::size_t n>
py::object to_python(const std::array<Number, n>& numbers) {
  py::tuple result(n);
  for (std::size_t i = 0; i < n; ++i) result[i] = numbers[i];
  return result;
}

/// Rows of three numbers; refuses arrays of another shape. `what` is what messages call them.
pliant::Positions read_rows(py::handle given, const std::string& what);
/// A list of elements of n vertices each.
template <std::size_t n>
std::vector<std::array<pliant::Index, n>> read_elements(py::handle given, const std::string& what);

/// An array of its own with these numbers.
py::array_t<double> copied_rows(const pliant::Positions& rows);

/// Reads each option that the keyword arguments give into a struct of options; None leaves the default.
struct OptionReader {
  const py::dict& given;
  std::string_view owner;
  const pliant::Mesh* mesh;

  template <class Option>
  void operator()(const pliant::OptionInfo& info, Option& option) const {
    const py::str name(info.name.data(), info.name.size());
    if (!given.contains(name)) return;
    const py::object value = given[name];
    if (value.is_none()) return;
    if constexpr (std::is_same_v<Option, pliant::Index>) {
      if (!info.word.empty() && py::isinstance<py::str>(value) && value.cast<std::string>() == info.word) {
        option = info.number_of_word;
        return;
      }
    }
    read(Place{owner, info, mesh}, value, option);
  }
};

/// Throws Error(input) on a keyword that is none of these names, with the nearest ones.
void check_keywords(std::string_view owner, const py::dict& given, const std::vector<std::string_view>& names);

}  // namespace pliant_python
