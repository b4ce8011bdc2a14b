#include "own_types.h"

#include "array_constraints.h"
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
