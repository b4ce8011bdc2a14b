#include "array_constraints.h"

#include <algorithm>
#include <array>

#include "pliant/core/error.h"

namespace pliant_python {
namespace {

using pliant::Index;
using pliant::Positions;
using pliant::Real;

constexpr auto real_size = static_cast<py::ssize_t>(sizeof(Real));

std::vector<Real> list_of(const Numbers& array) {
  return {array.data(), array.data() + array.size()};
}

void make_read_only(const py::object& array) {
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
}

/// Numbers in memory that nobody else can write; a copy of what is kept elsewhere. Null of what is not numbers.
py::object readable(const py::object& given) {
  const py::ssize_t holders = given.ref_count();
  const auto numbers = py::array_t<Real, py::array::forcecast>::ensure(given);
  if (!numbers) return {};
  bool in_place = numbers.owndata() && (numbers.ptr() == given.ptr() ? holders : numbers.ref_count()) == 1;
  for (py::ssize_t axis = 0; axis < numbers.ndim(); ++axis) in_place &= numbers.strides(axis) % real_size == 0;
  return in_place ? py::object(numbers) : numbers.attr("copy")("K");
}

/// One row of A of each constraint.
struct Coefficients {
  const Real* first;
  std::size_t step;  // to those of the next constraint; 0: all have the same
};

/// A row of z of each constraint. known: the size of a stencil where the compiler is to know it, else 0.
template <std::size_t known>
void sum_up(const Positions& positions, std::span<const Index> stencils, std::size_t size, Coefficients of,
            const std::array<Real*, 3>& out) {
  const std::size_t n = known == 0 ? size : known;
  const Real* const points = positions.data();
  const Real* coefficients = of.first;
  const Index* stencil = stencils.data();
  const std::size_t count = stencils.size() / n;
  for (std::size_t i = 0; i < count; ++i, stencil += n, coefficients += of.step) {
    Real x = 0, y = 0, z = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const Real* const point = points + 3 * pliant::at(stencil[j]);
      x += coefficients[j] * point[0];
      y += coefficients[j] * point[1];
      z += coefficients[j] * point[2];
    }
    out[0][i] = x, out[1][i] = y, out[2][i] = z;
  }
}

/// Whether all constraints have the coefficients of the first.
bool all_alike(std::span<const Real> reduction, std::size_t size) {
  return reduction.empty() ||
         std::equal(reduction.begin() + static_cast<std::ptrdiff_t>(size), reduction.end(), reduction.begin());
}

}  // namespace

ArrayConstraints::Array ArrayConstraints::array_of(py::array array) {
  Array result;
  result.data = static_cast<const Real*>(array.data());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.steps[axis] = array.strides(static_cast<py::ssize_t>(axis)) / real_size;
  }
  result.owner = std::move(array);
  return result;
}

ArrayConstraints::ArrayConstraints(std::string type, py::object project, const Indices& indices,
                                   const Numbers& reduction, const Numbers& measure, const Numbers& fields,
                                   Real stiffness)
    : ConstraintGroup(stiffness),
      type_(std::move(type)),
      project_(std::move(project)),
      shape_{static_cast<Index>(indices.shape(0)), static_cast<int>(indices.shape(1)),
             static_cast<int>(reduction.shape(1))},
      stencil_(indices.data(), indices.data() + indices.size()),
      reduction_(list_of(reduction)),
      is_uniform_(all_alike(reduction_, pliant::at(shape_.vertices) * pliant::at(shape_.rows))),
      measure_(list_of(measure)),
      fields_(fields.attr("copy")("F")) {
  make_read_only(fields_);
}

ArrayConstraints::~ArrayConstraints() {
  const py::gil_scoped_acquire lock;  // it may be dropped on any thread
  project_ = {};
  fields_ = {};
  all_ = {};
}

py::array ArrayConstraints::new_z(Index count) const {
  const auto n = static_cast<py::ssize_t>(count);
  const auto rows = static_cast<py::ssize_t>(shape_.rows);
  return py::array_t<Real>({n, rows, py::ssize_t{3}}, {real_size, real_size * n, real_size * n * rows});
}

/// Into z, which then cannot be written from Python.
ArrayConstraints::Array ArrayConstraints::gather(const Positions& positions, Index begin, Index end,
                                                 py::array z) const {
  const auto n = static_cast<std::size_t>(shape_.vertices);
  const auto rows = static_cast<std::size_t>(shape_.rows);
  const auto count = static_cast<std::size_t>(end - begin);
  const std::size_t plane = rows * count;
  void* const memory = py::detail::array_proxy(z.ptr())->data;
  const std::span<const Index> stencils = std::span(stencil_).subspan(pliant::at(begin) * n, count * n);
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t first = is_uniform_ ? 0 : pliant::at(begin) * rows;
    const Coefficients row_of_A{reduction_.data() + (first + row) * n, is_uniform_ ? 0 : rows * n};
    Real* const x = static_cast<Real*>(memory) + row * count;
    const std::array<Real*, 3> out = {x, x + plane, x + 2 * plane};
    n == 1   ? sum_up<1>(positions, stencils, n, row_of_A, out)
    : n == 2 ? sum_up<2>(positions, stencils, n, row_of_A, out)
    : n == 3 ? sum_up<3>(positions, stencils, n, row_of_A, out)
    : n == 4 ? sum_up<4>(positions, stencils, n, row_of_A, out)
             : sum_up<0>(positions, stencils, n, row_of_A, out);
  }
  make_read_only(z);
  return array_of(std::move(z));
}

ArrayConstraints::Array ArrayConstraints::call(const Array& z, Index begin, Index end) const {
  const py::object given = project_(z.owner, fields_[py::slice(begin, end, 1)]);
  const py::object p = readable(given);
  const py::object shape = py::make_tuple(end - begin, shape_.rows, 3);
  if (!p || !py::object(p.attr("shape")).equal(shape)) {
    pliant::fail_input(type_ + ": project() must return numbers in the shape of z, (" + std::to_string(end - begin) +
                       ", " + std::to_string(shape_.rows) + ", 3)");
  }
  return array_of(py::reinterpret_borrow<py::array>(p));
}

ArrayConstraints::Projected ArrayConstraints::projected(const Positions& positions, Index begin, Index end) const {
  Projected result{.z = gather(positions, begin, end, new_z(end - begin)), .p = {}, .begin = begin};
  result.p = call(result.z, begin, end);
  return result;
}

void ArrayConstraints::begin_local_step(const Positions& positions) {
  if (shape_.count == 0) return;
  const py::gil_scoped_acquire lock;
  begun_at_ = nullptr;
  all_.p = {};
  py::object& z = all_.z.owner;
  const bool is_free = z && z.ref_count() == 1;  // one that the function has kept stays as it is
  all_.z =
      gather(positions, 0, shape_.count, is_free ? py::reinterpret_steal<py::array>(z.release()) : new_z(shape_.count));
  all_.p = call(all_.z, 0, shape_.count);
  begun_at_ = &positions;
}

Real ArrayConstraints::project(const Positions& positions, std::span<Real> out, Index begin, Index end) const {
  if (begun_at_ == &positions) return weigh(all_, out, begin, end);
  const py::gil_scoped_acquire lock;
  return weigh(projected(positions, begin, end), out, begin, end);
}

Real ArrayConstraints::project_to_forces(const Positions& positions, std::span<Real> out, Index begin,
                                         Index end) const {
  if (begun_at_ == &positions) return pull(all_, out, begin, end);
  const py::gil_scoped_acquire lock;
  return pull(projected(positions, begin, end), out, begin, end);
}

/// The rows w (p − z).
Real ArrayConstraints::weigh(const Projected& projected, std::span<Real> out, Index begin, Index end) const {
  const Array& z = projected.z;
  const Array& p = projected.p;
  const auto rows = static_cast<py::ssize_t>(shape_.rows);
  Real energy = 0;
  Real* to = out.data();
  for (Index i = begin; i < end; ++i) {
    const Real weight = stiffness() * measure_[pliant::at(i)];
    const Real* from = z.data + (i - projected.begin) * z.steps[0];
    const Real* nearest = p.data + (i - projected.begin) * p.steps[0];
    Real squared = 0;
    for (py::ssize_t row = 0; row < rows; ++row, from += z.steps[1], nearest += p.steps[1], to += 3) {
      const Real x = nearest[0] - from[0];
      const Real y = nearest[p.steps[2]] - from[z.steps[2]];
      const Real w = nearest[2 * p.steps[2]] - from[2 * z.steps[2]];
      squared += x * x + y * y + w * w;
      to[0] = weight * x, to[1] = weight * y, to[2] = weight * w;
    }
    energy += weight / 2 * squared;
  }
  return energy;
}

/// The forces Aᵀ w (p − z).
Real ArrayConstraints::pull(const Projected& projected, std::span<Real> out, Index begin, Index end) const {
  const auto n = static_cast<std::size_t>(shape_.vertices);
  const auto rows = static_cast<std::size_t>(shape_.rows);
  std::array<Real, 3 * pliant::max_force_rows> room;
  const std::span<Real> slots = std::span<Real>(room).first(3 * rows);
  const Real* A = reduction_.data() + pliant::at(begin) * rows * n;
  Real* to = out.data();
  Real energy = 0;
  for (Index i = begin; i < end; ++i, A += rows * n) {
    energy += weigh(projected, slots, i, i + 1);
    for (std::size_t j = 0; j < n; ++j, to += 3) {
      std::fill_n(to, 3, Real(0));
      for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t axis = 0; axis < 3; ++axis) to[axis] += A[row * n + j] * slots[3 * row + axis];
      }
    }
  }
  return energy;
}

}  // namespace pliant_python
