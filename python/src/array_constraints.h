#pragma once
// Constraints whose projection is written with NumPy.
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "convert.h"
#include "pliant/constraints/constraint_group.h"

namespace pliant_python {

/// A function of Python, and the arrays that go in and come out. z is (count, rows, 3), in memory (3, rows, count):
/// springs of the benchmark take NumPy a third of the time that they take in the usual order.
class ArrayConstraints final : public pliant::ConstraintGroup {
 public:
  ArrayConstraints(std::string type, py::object project, const Indices& indices, const Numbers& reduction,
                   const Numbers& measure, const Numbers& fields, pliant::Real stiffness);
  ~ArrayConstraints() override;

  std::string_view type() const override { return type_; }
  pliant::GroupShape shape() const override { return shape_; }
  std::span<const pliant::Index> stencil() const override { return stencil_; }
  std::span<const pliant::Real> reduction() const override { return reduction_; }
  std::span<const pliant::Real> rest_measure() const override { return measure_; }

  /// One call of the function in a local step, for all constraints; project() then reads, on every thread.
  void begin_local_step(const pliant::Positions& positions) override;
  void end_local_step() noexcept override { begun_at_ = nullptr; }
  pliant::Real project(const pliant::Positions& positions, std::span<pliant::Real> out, pliant::Index begin,
                       pliant::Index end) const override;
  pliant::Real project_to_forces(const pliant::Positions& positions, std::span<pliant::Real> out, pliant::Index begin,
                                 pliant::Index end) const override;

 private:
  struct Array {
    py::object owner;
    const pliant::Real* data = nullptr;
    std::array<py::ssize_t, 3> steps{};  // from one constraint, row and axis to the next
  };
  struct Projected {
    Array z;
    Array p;
    pliant::Index begin = 0;  // the first constraint of it
  };

  static Array array_of(py::array array);
  Array gather(const pliant::Positions& positions, pliant::Index begin, pliant::Index end, py::array z) const;
  py::array new_z(pliant::Index count) const;
  Array call(const Array& z, pliant::Index begin, pliant::Index end) const;
  Projected projected(const pliant::Positions& positions, pliant::Index begin, pliant::Index end) const;
  pliant::Real weigh(const Projected& projected, std::span<pliant::Real> out, pliant::Index begin,
                     pliant::Index end) const;
  pliant::Real pull(const Projected& projected, std::span<pliant::Real> out, pliant::Index begin,
                    pliant::Index end) const;

  std::string type_;
  py::object project_;
  pliant::GroupShape shape_;
  std::vector<pliant::Index> stencil_;
  std::vector<pliant::Real> reduction_;
  bool is_uniform_;  // the same reduction for all
  std::vector<pliant::Real> measure_;
  py::object fields_;  // (count, f), one column after the other
  Projected all_;
  const pliant::Positions* begun_at_ = nullptr;  // what all_ was projected from; null outside of a local step
};

}  // namespace pliant_python
