#include "convert.h"

#include "pliant_io/scene/select.h"

namespace pliant_python {

using pliant::Index;
using pliant::Real;
using pliant::Vec3;

namespace {

std::string shown(py::handle value) {
  std::string text;
  try {
    text = py::repr(value).cast<std::string>();
  } catch (const py::error_already_set&) {
    text = "a value without a repr";
  }
  constexpr std::size_t most = 60;
  for (char& each : text) each = each == '\n' ? ' ' : each;
  return text.size() <= most ? text : text.substr(0, most) + "...";
}

std::string unit_of(const Place& place) {
  return place.info.unit.empty() ? "" : " [" + std::string(place.info.unit) + "]";
}

bool is_text(py::handle value) {
  return py::isinstance<py::str>(value);
}

/// Numbers in an array of any shape; null when they are none.
Numbers numbers_in(py::handle given) {
  if (is_text(given) || given.is_none() || py::isinstance<py::dict>(given))
    return py::reinterpret_steal<Numbers>(py::handle());
  Numbers array = Numbers::ensure(given);
  PyErr_Clear();
  return array;
}

Vec3 vector_at(const Numbers& array, py::ssize_t row) {
  const double* const x = array.data() + 3 * row;
  return {x[0], x[1], x[2]};
}

/// Lists of unlike lengths, or a number for a list of one.
template <class Number>
void read_lists(const Place& place, py::handle given, pliant::Ragged<Number>& lists, const std::string& wanted) {
  if (is_text(given) || !py::isinstance<py::iterable>(given)) fail_type(place, given, wanted);
  lists = {};
  std::vector<Number> list;
  for (const py::handle entry : given) {
    list.clear();
    if (!is_text(entry) && py::isinstance<py::iterable>(entry)) {
      for (const py::handle number : entry) read(place, number, list.emplace_back());
    } else {
      read(place, entry, list.emplace_back());
    }
    lists.add(list);
  }
}

template <class Number>
py::object lists_to_python(const pliant::Ragged<Number>& lists) {
  py::list result;
  for (Index i = 0; i < lists.size(); ++i) {
    py::list list;
    for (const Number number : lists[i]) list.append(number);
    result.append(list);
  }
  return result;
}

/// Indices, or a mask of booleans.
std::vector<Index> vertices_in(const Place& place, py::handle given, const std::string& wanted) {
  const py::array array = py::array::ensure(given);
  PyErr_Clear();
  if (!array || array.ndim() != 1) fail_type(place, given, wanted);
  std::vector<Index> vertices;
  const char kind = array.dtype().kind();
  if (kind == 'b') {
    const auto mask = py::array_t<bool, py::array::forcecast>::ensure(array);
    if (place.mesh != nullptr && mask.size() != place.mesh->vertex_count()) {
      fail(place, "the mask has " + std::to_string(mask.size()) + " entries; give one for each of the " +
                      std::to_string(place.mesh->vertex_count()) + " vertices");
    }
    for (py::ssize_t i = 0; i < mask.size(); ++i) {
      if (mask.at(i)) vertices.push_back(static_cast<Index>(i));
    }
    if (vertices.empty()) fail(place, "the mask selects no vertex; select one at least");
    return vertices;
  }
  if (array.size() > 0 && kind != 'i' && kind != 'u') fail_type(place, given, wanted);
  for (const py::handle entry : array) read(place, entry, vertices.emplace_back());
  return vertices;
}

}  // namespace

void fail(const Place& place, const std::string& what) {
  pliant::fail_input(std::string(place.owner) + ": " + std::string(place.info.name) + ": " + what);
}

void fail_type(const Place& place, py::handle found, const std::string& wanted) {
  fail(place, "found " + shown(found) + "; give " + wanted + unit_of(place));
}

void read(const Place& place, py::handle given, Real& number) {
  const bool is_number = !py::isinstance<py::bool_>(given) && PyNumber_Check(given.ptr()) != 0 && !is_text(given);
  number = is_number ? PyFloat_AsDouble(given.ptr()) : 0;
  if (is_number && PyErr_Occurred() == nullptr) return;
  PyErr_Clear();
  fail_type(place, given, "a number");
}

void read(const Place& place, py::handle given, std::int64_t& number) {
  Real real = 0;
  read(place, given, real);
  if (real != std::floor(real) || std::abs(real) > 9007199254740992.0) fail_type(place, given, "a whole number");
  number = static_cast<std::int64_t>(real);
}

void read(const Place& place, py::handle given, Index& number) {
  std::int64_t large = 0;
  read(place, given, large);
  if (large < std::numeric_limits<Index>::min() || large > std::numeric_limits<Index>::max()) {
    fail_type(place, given, "a whole number of at most 32 bits");
  }
  number = static_cast<Index>(large);
}

void read(const Place& place, py::handle given, bool& flag) {
  if (py::isinstance<py::bool_>(given) || py::hasattr(given, "dtype")) {
    flag = given.cast<bool>();
    return;
  }
  fail_type(place, given, "True or False");
}

void read(const Place& place, py::handle given, std::string& text) {
  if (!is_text(given)) fail_type(place, given, "a string");
  text = given.cast<std::string>();
}

void read(const Place& place, py::handle given, Vec3& vector) {
  const Numbers array = numbers_in(given);
  if (!array || array.ndim() != 1 || array.size() != 3) fail_type(place, given, "three numbers");
  vector = vector_at(array, 0);
}

void read(const Place& place, py::handle given, pliant::Values& values) {
  const py::object inner = py::getattr(given, "per_vertex", py::none());
  const Numbers array = numbers_in(inner.is_none() ? given : py::handle(inner));
  if (!array || array.ndim() > 1) fail_type(place, given, "a number, a list of numbers or a PerVertex");
  std::vector<Real> list(array.data(), array.data() + array.size());
  if (array.ndim() == 0) {
    values = list.front();
  } else if (!inner.is_none()) {
    values = pliant::Values::of_vertices(std::move(list));
  } else {
    values = std::move(list);
  }
}

void read(const Place& place, py::handle given, pliant::Points& points) {
  const Numbers array = numbers_in(given);
  const bool is_one = array && array.ndim() == 1 && array.size() == 3;
  const bool is_list = array && array.ndim() == 2 && array.shape(1) == 3;
  if (!is_one && !is_list) fail_type(place, given, "three numbers, or a list of such");
  if (is_one) {
    points = vector_at(array, 0);
    return;
  }
  std::vector<Vec3> list;
  for (py::ssize_t i = 0; i < array.shape(0); ++i) list.push_back(vector_at(array, i));
  points = std::move(list);
}

void read(const Place& place, py::handle given, pliant::Ragged<Real>& lists) {
  read_lists(place, given, lists, "a list of lists of numbers");
}

void read(const Place& place, py::handle given, pliant::Stencils& stencils) {
  read_lists(place, given, stencils, "a list of lists of vertex indices");
}

void read(const Place& place, py::handle given, pliant::Selection& selection) {
  const std::string wanted =
      "\"all\", \"boundary\", vertex indices, a mask of booleans, or a selection of scene files such as {\"box\": ...}";
  if (!is_text(given) && !py::isinstance<py::dict>(given)) {
    selection = pliant::Selection(vertices_in(place, given, wanted));
    return;
  }
  if (is_text(given) && given.cast<std::string>() == "all") {
    selection = {};
    return;
  }
  if (place.mesh == nullptr) return;
  const auto json = py::module_::import("json").attr("dumps")(given).cast<std::string>();
  selection = pliant::select(json, *place.mesh, std::string(place.owner) + ": " + std::string(place.info.name));
}

void read(const Place& place, py::handle given, pliant::BodyId& body) {
  const py::object index = py::getattr(given, "_body", py::none());
  if (index.is_none()) fail_type(place, given, "a body, as add_body() returns it");
  body = pliant::BodyId{index.cast<Index>()};
}

void read(const Place& place, py::handle given, std::vector<pliant::BodyId>& bodies) {
  if (is_text(given) || !py::isinstance<py::iterable>(given)) fail_type(place, given, "a list of bodies");
  for (const py::handle body : given) read(place, body, bodies.emplace_back());
}

std::size_t read_choice(const Place& place, py::handle given, const std::vector<std::string_view>& names) {
  std::string name;
  if (!is_text(given)) fail_type(place, given, "one of " + pliant::suggestion_text("", names));
  name = given.cast<std::string>();
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) return i;
  }
  fail(place, "unknown choice '" + name + "'; " + pliant::suggestion_text(name, names));
}

py::object to_python(const Vec3& vector) {
  return py::make_tuple(vector[0], vector[1], vector[2]);
}

py::object to_python(const pliant::Values& values) {
  if (values.empty()) return py::none();
  if (!values.each()) return py::float_(values[0]);
  py::object list = py::array_t<double>(static_cast<py::ssize_t>(values.list().size()), values.list().data());
  if (values.of_vertices()) return py::module_::import("pliant").attr("PerVertex")(list);
  return list;
}

py::object to_python(const pliant::Points& points) {
  if (points.empty()) return py::none();
  if (!points.each()) return to_python(points[0]);
  py::list list;
  for (const Vec3& point : points.list()) list.append(to_python(point));
  return list;
}

py::object to_python(const pliant::Ragged<Real>& lists) {
  return lists.empty() ? py::object(py::none()) : lists_to_python(lists);
}

py::object to_python(const pliant::Stencils& stencils) {
  return stencils.empty() ? py::object(py::none()) : lists_to_python(stencils);
}

py::object to_python(const pliant::Selection& selection) {
  if (selection.everything) return py::str("all");
  return py::cast(selection.vertices);
}

py::object to_python(pliant::BodyId body) {
  return py::module_::import("pliant").attr("BodyId")(static_cast<Index>(body));
}

py::object to_python(const std::vector<pliant::BodyId>& bodies) {
  py::list list;
  for (const pliant::BodyId body : bodies) list.append(to_python(body));
  return list;
}

pliant::Positions read_rows(py::handle given, const std::string& what) {
  const Numbers array = numbers_in(given);
  if (!array || array.ndim() != 2 || array.shape(1) != 3) {
    pliant::fail_input(what + ": found " + shown(given) + "; give an array of m x 3 numbers");
  }
  return Eigen::Map<const pliant::Positions>(array.data(), array.shape(0), 3);
}

template <std::size_t n>
std::vector<std::array<Index, n>> read_elements(py::handle given, const std::string& what) {
  const auto array = py::array::ensure(given);
  PyErr_Clear();
  const bool is_whole = array && (array.dtype().kind() == 'i' || array.dtype().kind() == 'u');
  if (array && array.size() == 0) return {};
  if (!is_whole || array.ndim() != 2 || array.shape(1) != static_cast<py::ssize_t>(n)) {
    pliant::fail_input(what + ": found " + shown(given) + "; give an array of k x " + std::to_string(n) +
                       " vertex indices");
  }
  const Indices indices = Indices::ensure(array);
  std::vector<std::array<Index, n>> elements(static_cast<std::size_t>(array.shape(0)));
  std::copy_n(indices.data(), array.size(), elements.empty() ? nullptr : elements.front().data());
  return elements;
}
template std::vector<std::array<Index, 2>> read_elements<2>(py::handle, const std::string&);
template std::vector<std::array<Index, 3>> read_elements<3>(py::handle, const std::string&);
template std::vector<std::array<Index, 4>> read_elements<4>(py::handle, const std::string&);

py::array_t<double> copied_rows(const pliant::Positions& rows) {
  return py::array_t<double>({rows.rows(), py::ssize_t{3}}, rows.data());
}

void check_keywords(std::string_view owner, const py::dict& given, const std::vector<std::string_view>& names) {
  for (const auto& [key, value] : given) {
    const auto name = key.cast<std::string>();
    if (std::ranges::find(names, name) != names.end()) continue;
    pliant::fail_input(std::string(owner) + ": unknown option '" + name + "'; " + pliant::suggestion_text(name, names));
  }
}

}  // namespace pliant_python
