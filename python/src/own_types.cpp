#include "own_types.h"

#include "pliant/constraints/constraint_set.h"
#include "pliant/forces/force.h"

namespace pliant_python {
namespace {

using pliant::Index;
using pliant::Positions;
using pliant::Real;

/// An object of Python that may be dropped on any thread.
class Callable {
 public:
  explicit Callable(py::object object)
      : object_(new py::object(std::move(object)), [](py::object* held) {
          const py::gil_scoped_acquire lock;
          delete held;
        }) {}
  const py::object& get() const { return *object_; }

 private:
  std::shared_ptr<py::object> object_;
};

std::vector<Real> list_of(const Numbers& array) {
  return {array.data(), array.data() + array.size()};
}

class ArrayConstraints final : public pliant::ConstraintGroup {
 public:
  ArrayConstraints(std::string type, py::object project, const Indices& indices, const Numbers& reduction,
                   const Numbers& measure, const Numbers& fields, Real stiffness)
      : ConstraintGroup(stiffness),
        type_(std::move(type)),
        project_(std::move(project)),
        shape_{static_cast<Index>(indices.shape(0)), static_cast<int>(indices.shape(1)),
               static_cast<int>(reduction.shape(1))},
        stencil_(indices.data(), indices.data() + indices.size()),
        reduction_(list_of(reduction)),
        measure_(list_of(measure)),
        fields_(list_of(fields)),
        field_count_(fields.shape(1)) {}

  std::string_view type() const override { return type_; }
  pliant::GroupShape shape() const override { return shape_; }
  std::span<const Index> stencil() const override { return stencil_; }
  std::span<const Real> reduction() const override { return reduction_; }
  std::span<const Real> rest_measure() const override { return measure_; }

  Real project(const Positions& positions, std::span<Real> out, Index begin, Index end) const override {
    const py::gil_scoped_acquire lock;
    const auto rows = static_cast<py::ssize_t>(shape_.rows);
    Numbers z({static_cast<py::ssize_t>(end - begin), rows, py::ssize_t{3}});
    gather(positions, begin, end, z.mutable_data());
    Numbers fields({static_cast<py::ssize_t>(end - begin), field_count_});
    std::copy_n(fields_.data() + begin * field_count_, fields.size(), fields.mutable_data());
    const py::object given = project_.get()(z.attr("copy")(), fields);
    const Numbers p = Numbers::ensure(given);
    if (!p || p.ndim() != 3 || p.shape(0) != z.shape(0) || p.shape(1) != rows || p.shape(2) != 3) {
      PyErr_Clear();
      pliant::fail_input(type_ + ": project() must return numbers in the shape of z, (" + std::to_string(end - begin) +
                         ", " + std::to_string(rows) + ", 3)");
    }
    return weigh(z.data(), p.data(), out, begin, end);
  }

  Real project_to_forces(const Positions& positions, std::span<Real> out, Index begin, Index end) const override {
    const auto n = static_cast<std::size_t>(shape_.vertices);
    const auto rows = static_cast<std::size_t>(shape_.rows);
    const auto count = static_cast<std::size_t>(end - begin);
    std::vector<Real> slots(count * rows * 3);
    const Real energy = project(positions, slots, begin, end);
    const Real* A = reduction_.data() + static_cast<std::size_t>(begin) * rows * n;
    for (std::size_t i = 0; i < count; ++i, A += rows * n) {
      const Eigen::Map<const Positions> rows_of(slots.data() + i * rows * 3, static_cast<Eigen::Index>(rows), 3);
      const Eigen::Map<const Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> matrix(
          A, static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(n));
      Eigen::Map<Positions>(out.data() + i * n * 3, static_cast<Eigen::Index>(n), 3) = matrix.transpose() * rows_of;
    }
    return energy;
  }

 private:
  void gather(const Positions& positions, Index begin, Index end, Real* z) const {
    const auto n = static_cast<std::size_t>(shape_.vertices);
    const auto rows = static_cast<std::size_t>(shape_.rows);
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      for (std::size_t row = 0; row < rows; ++row, z += 3) {
        std::fill_n(z, 3, Real(0));
        for (std::size_t j = 0; j < n; ++j) {
          const Real coefficient = reduction_[(i * rows + row) * n + j];
          const Real* const x = positions.data() + 3 * pliant::at(stencil_[i * n + j]);
          for (std::size_t axis = 0; axis < 3; ++axis) z[axis] += coefficient * x[axis];
        }
      }
    }
  }

  Real weigh(const Real* z, const Real* p, std::span<Real> out, Index begin, Index end) const {
    const auto size = 3 * static_cast<std::size_t>(shape_.rows);
    Real energy = 0;
    Real* to = out.data();
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const Real weight = stiffness() * measure_[i];
      Real squared = 0;
      for (std::size_t a = 0; a < size; ++a, ++to, ++z, ++p) {
        const Real d = *p - *z;
        squared += d * d;
        *to = weight * d;
      }
      energy += weight / 2 * squared;
    }
    return energy;
  }

  std::string type_;
  Callable project_;
  pliant::GroupShape shape_;
  std::vector<Index> stencil_;
  std::vector<Real> reduction_;
  std::vector<Real> measure_;
  std::vector<Real> fields_;
  py::ssize_t field_count_;
};

class ArrayForce final : public pliant::Force {
 public:
  ArrayForce(std::string type, py::object force) : type_(std::move(type)), force_(std::move(force)) {}

  std::string_view type() const override { return type_; }

  void add_to(Positions& forces, const pliant::StateView& state, Real time_step) override {
    const py::gil_scoped_acquire lock;
    const py::array_t<double> masses(static_cast<py::ssize_t>(state.masses.size()), state.masses.data());
    const py::object given =
        force_.get()(copied_rows(state.positions), copied_rows(state.velocities), masses, state.time, time_step);
    const Positions added = read_rows(given, type_ + ": what force() returns");
    if (added.rows() != forces.rows()) {
      pliant::fail_input(type_ + ": force() returned " + std::to_string(added.rows()) + " rows; give one for each of " +
                         std::to_string(forces.rows()) + " vertices");
    }
    forces += added;
  }

 private:
  std::string type_;
  Callable force_;
};

}  // namespace

pliant::ConstraintSet own_constraints(const std::string& type, py::object project, const Indices& indices,
                                      const Numbers& reduction, const Numbers& measure, const Numbers& fields,
                                      double stiffness) {
  const bool fits = indices.ndim() == 2 && reduction.ndim() == 3 && measure.ndim() == 1 && fields.ndim() == 2 &&
                    reduction.shape(0) == indices.shape(0) && reduction.shape(2) == indices.shape(1) &&
                    measure.shape(0) == indices.shape(0) && fields.shape(0) == indices.shape(0);
  if (!fits) {
    pliant::fail_input(type +
                       ": the shapes do not fit; give stencils (count, n), reduction (rows, n) or (count, rows, " +
                       "n), and one measure and one row of fields for each constraint");
  }
  pliant::ConstraintSet set;
  set.count = static_cast<Index>(indices.shape(0));
  set.batches.push_back(
      std::make_unique<ArrayConstraints>(type, std::move(project), indices, reduction, measure, fields, stiffness));
  return set;
}

std::unique_ptr<pliant::Force> own_force(const std::string& type, py::object force) {
  return std::make_unique<ArrayForce>(type, std::move(force));
}

}  // namespace pliant_python
