#pragma once
// The one loop over stencils. A constraint type is a struct with
//     static constexpr std::string_view name;
//     static constexpr int vertices;                  // n, or dynamic_vertices: then every batch has an n of its own
//     static constexpr int rows, fields;              // k; numbers of rest data a constraint
//     static constexpr bool translation_invariant;    // every row of every A sums to zero
//     static void project(const Real* fields, const Real* z, Real* p);   // z, p: k × 3; or a potential, see pull.h
// and, where it needs them,
//     static constexpr bool has_targets = true;       // the three fields are a point that may be moved
//     static constexpr bool has_anchors = true;       // the first three are a point that begins at the vertices
//     static constexpr auto kernel = &LocalKernels::edge_spring;   // does many at once, in place of project
//     static constexpr bool rotation_invariant = true;   // projections turn with z, in the middle of a step as well
//     static constexpr bool is_linear = true;         // p = 0 whatever z is
//     static constexpr bool limits_stretches = true;  // z is a stretch or F, and p has stretches between limits
//     static constexpr bool is_difference = true;     // A is (−1, 1), which its kernel need not read
//     static constexpr bool comes_and_goes = true;    // stays out of the factor
//     static void begin_step(const Positions& q, std::span<const Index> stencil, Real* fields);
//     static bool go_to(Real from, Real to, Real* fields);   // what follows from the time alone; whether it changes
#include <array>
#include <cmath>
#include <string>

#include "pliant/constraints/batch_checks.h"
#include "pliant/constraints/lane_coefficients.h"
#include "pliant/constraints/pull.h"
#include "pliant/constraints/reorder.h"
#include "pliant/constraints/stencil_sum.h"
#include "pliant/core/error.h"

namespace pliant {

inline constexpr int dynamic_vertices = -1;

template <class Type>
class Batch final : public ConstraintGroup {
 public:
  /// `type` names it to people where several types of constraint project alike; it must outlive the batch.
  explicit Batch(Real stiffness, int vertices = Type::vertices, std::string_view type = Type::name)
      : ConstraintGroup(stiffness), vertices_(vertices), type_(type) {
    if (vertices < 1 || vertices > max_stencil) {
      fail_input(std::string(type) + ": a constraint over " + std::to_string(vertices) + " vertices, which all " +
                 "meet in the system matrix; give 1 to " + std::to_string(max_stencil) + ", or leave it out");
    }
  }

  /// One more constraint: n vertices, k × n coefficients, its measure, and the fields of its type. Throws Error(input)
  /// on lists of the wrong length, and on rows that do not sum to zero where the type says so.
  void add(std::span<const Index> stencil, std::span<const Real> reduction, Real measure,
           std::span<const Real> fields) {
    check_constraint<Type>(type_, shape(), stencil.size(), reduction, fields.size());
    // One by one: of a range insertion, g++ 12 warns without cause in programs that include this.
    for (const Index vertex : stencil) stencil_.push_back(vertex);
    for (const Real coefficient : reduction) reduction_.push_back(coefficient);
    for (const Real field : fields) fields_.push_back(field);
    if constexpr (has_coefficients) coefficients_.add(reduction);
    rest_measure_.push_back(measure);
    changed();
  }

  std::string_view type() const override { return type_; }
  GroupShape shape() const override { return {static_cast<Index>(rest_measure_.size()), vertices(), Type::rows}; }
  std::span<const Index> stencil() const override { return stencil_; }
  std::span<const Real> reduction() const override { return reduction_; }
  std::span<const Real> rest_measure() const override { return rest_measure_; }
  std::span<const Real> fields() const { return fields_; }

  std::span<Real> targets() override {
    static_assert(!has_targets || Type::fields == 3, "the targets of a batch are its fields");
    return has_targets ? std::span<Real>(fields_) : std::span<Real>();
  }

  std::span<Real> anchor(Index i) override {
    if constexpr (requires { Type::has_anchors; }) {
      static_assert(Type::fields >= 3, "an anchor is the first three fields");
      return {field(static_cast<std::size_t>(i)), 3};
    } else {
      return ConstraintGroup::anchor(i);
    }
  }
  std::span<Real> parameters() override { return fields_; }

  std::unique_ptr<ConstraintGroup> reordered(std::span<const Index> order,
                                             std::span<const Index> numbers) const override {
    const auto n = static_cast<std::size_t>(vertices());
    auto batch = std::make_unique<Batch>(stiffness(), vertices_, type_);
    batch->set_factor_share(factor_share());
    batch->stencil_ = in_order(stencil(), order, n);
    for (Index& vertex : batch->stencil_) vertex = numbers[static_cast<std::size_t>(vertex)];
    batch->reduction_ = in_order(reduction(), order, n * Type::rows);
    if constexpr (has_coefficients) batch->coefficients_.add_all(batch->reduction_);
    batch->rest_measure_ = in_order(rest_measure(), order, 1);
    batch->fields_ = in_order(fields(), order, Type::fields);
    return batch;
  }
  void sync_parameters(const ConstraintGroup& from, std::span<const Index> order) override {
    ConstraintGroup::sync_parameters(from, order);
    take_in_order(dynamic_cast<const Batch&>(from).fields(), order, Type::fields, std::span<Real>(fields_));
  }
  std::unique_ptr<ConstraintGroup> copy() const override { return std::make_unique<Batch>(*this); }
  bool freezes_shape() const override { return has_begin_step; }
  bool is_rotation_invariant() const override { return rotates_along; }
  bool is_linear() const override { return has_linear; }
  bool is_projective() const override { return !has_potential<Type> && factor_share() >= 0.5; }
  bool limits_stretches() const override { return has_stretches; }
  bool comes_and_goes() const override { return passes; }
  void begin_step(const StateView& state, [[maybe_unused]] Real time_step) override {
    const auto n = static_cast<std::size_t>(vertices());
    bool is_driven = false;
    for (std::size_t i = 0; (has_begin_step || goes_with_time) && i < rest_measure_.size(); ++i) {
      if constexpr (goes_with_time) is_driven |= Type::go_to(state.time, state.time + time_step, field(i));
      if constexpr (has_begin_step) Type::begin_step(state.positions, std::span(stencil_).subspan(i * n, n), field(i));
    }
    set_driven(is_driven);
  }

  Real project(const Positions& positions, std::span<Real> out, Index begin, Index end) const override {
    if constexpr (has_kernel && Type::rows == 1) return project_together(positions, out, begin, end);
    Real energy = 0;
    for (Index i = begin; i < end; ++i, out = out.subspan(size)) {
      energy += project_one(positions.data(), static_cast<std::size_t>(i), out.data());
    }
    return energy;
  }

  Real project_to_forces(const Positions& positions, std::span<Real> out, Index begin, Index end) const override {
    if constexpr (has_kernel && Type::rows > 1) return project_together(positions, out, begin, end);
    return ConstraintGroup::project_to_forces(positions, out, begin, end);
  }

 private:
  std::span<Real> own_measures() override { return rest_measure_; }
  static constexpr std::size_t size = Type::rows * 3;
  static constexpr bool has_targets = requires { Type::has_targets; };
  static constexpr bool has_kernel = requires { Type::kernel; };
  static constexpr bool is_difference = requires { Type::is_difference; };
  static constexpr bool has_coefficients =  // that its kernel reads
      has_kernel && !is_difference && Type::vertices != dynamic_vertices;
  static constexpr auto coefficients_size =
      static_cast<std::size_t>(has_coefficients ? Type::rows * (Type::vertices - 1) : 0);
  static constexpr bool has_linear = requires { Type::is_linear; };
  static constexpr bool rotates_along = requires { Type::rotation_invariant; };
  static constexpr bool passes = requires { Type::comes_and_goes; };
  static constexpr bool has_stretches = requires { Type::limits_stretches; };
  static constexpr bool has_begin_step = requires { &Type::begin_step; };
  static constexpr bool goes_with_time = requires { &Type::go_to; };

  /// Writes w (p − z) of constraint i; returns its energy.
  Real project_one(const Real* positions, std::size_t i, Real* to) const {
    std::array<Real, size> z;
    const auto n = static_cast<std::size_t>(vertices());
    sum_stencil<Type::rows, Type::translation_invariant>(positions, std::span<const Index>(stencil_).subspan(i * n, n),
                                                         reduction_.data() + i * n * Type::rows, z.data());
    const Real weight = stiffness() * rest_measure_[i];
    const Real energy = weight * find_pull<Type>(field(i), z.data(), to);
    for (std::size_t a = 0; a < size; ++a) to[a] *= weight;
    return energy;
  }
  /// What the kernel of the type writes, and for what that leaves the same, one by one.
  Real project_together(const Positions& positions, std::span<Real> out, Index begin, Index end) const {
    static_assert(Type::translation_invariant);
    const auto n = static_cast<std::size_t>(vertices());
    const std::size_t numbers = 3 * (Type::rows == 1 ? 1 : n);
    const LocalKernels& kernels = fastest_kernels();
    const auto last = static_cast<std::size_t>(end);
    std::array<Real, local_block * coefficients_size + 1> room;
    Real energy = 0;
    for (auto first = static_cast<std::size_t>(begin); first < last; first += local_block) {
      const std::size_t count = std::min(local_block, last - first);
      const Real* reduction = has_coefficients ? nullptr : reduction_.data() + n * Type::rows * first;
      const Real* coefficients = has_coefficients ? coefficients_.from(first, count, reduction_, room) : nullptr;
      const LocalDone done =
          (kernels.*Type::kernel)({positions.data(), stencil_.data() + n * first, reduction, coefficients, field(first),
                                   rest_measure_.data() + first, stiffness(), n, count, out.data()});
      energy += done.energy;
      for (std::size_t i = done.next(0); i < count; i = done.next(i + 1)) {
        const auto place = static_cast<Index>(first + i);
        energy += Type::rows == 1 ? project_one(positions.data(), first + i, out.data() + i * numbers)
                                  : ConstraintGroup::project_to_forces(positions, out.subspan(i * numbers, numbers),
                                                                       place, place + 1);
      }
      out = out.subspan(count * numbers);
    }
    return energy;
  }

  int vertices() const { return Type::vertices == dynamic_vertices ? vertices_ : Type::vertices; }
  Real* field(std::size_t i) { return fields_.data() + i * Type::fields; }
  const Real* field(std::size_t i) const { return fields_.data() + i * Type::fields; }

  int vertices_;
  std::string_view type_;
  std::vector<Index> stencil_;
  std::vector<Real> reduction_;
  LaneCoefficients coefficients_{Type::rows, has_coefficients ? Type::vertices : 1};
  std::vector<Real> rest_measure_;
  std::vector<Real> fields_;
};

}  // namespace pliant
