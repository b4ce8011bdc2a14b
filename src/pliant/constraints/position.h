#pragma once
// Position: a vertex is drawn to a target, or held there.
//
//     z = xᵢ        p = t        E = k/2 ‖xᵢ − t‖²
//
// Source: thesis Sec. 4.4.1 (Algorithm 3 is printed as a copy of Algorithm 4; A is the selection, and w enters once).
// `hard` takes the vertex out of the system of equations: it stands at its target from the first iteration on, and its
// neighbors feel it at once. `soft` is the thesis' form; started at the prediction, a soft pin hides gravity from the
// body until the iterations have converged.
#include "pliant/constraints/batch.h"
#include "pliant/constraints/constraint_set.h"

namespace pliant {

enum class Hold { hard, soft };
constexpr std::array<std::string_view, 2> choice_names(Hold) {
  return {"hard", "soft"};
}

struct Position {
  static constexpr ConstraintInfo info{"position", "xᵢ", "the target t", "½ k ‖xᵢ − t‖²", "thesis Sec. 4.4.1"};

  /// Vertices to pin; default: all.
  Selection on{};
  /// One vertex each, in place of `on`.
  Stencils stencils{};
  /// Exactly at the target, or drawn to it by the stiffness.
  Hold hold = Hold::hard;
  /// Of a soft pin [N/m], > 0; doubling it halves its distance from the target.
  Values stiffness = 1e5;
  /// Where to [m]: one for all, or one for each; default: where the vertex starts.
  Points targets{};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"on", "", "vertices to pin"}, self.on);
    field(OptionInfo{"stencils", "", "one vertex each, in place of `on`"}, self.stencils);
    field(OptionInfo{"hold", "", "`hard`: exactly at the target; `soft`: drawn to it by the stiffness"}, self.hold);
    field(OptionInfo{"stiffness", "N/m", "of a soft pin; doubling it halves its distance from the target", positive},
          self.stiffness);
    field(OptionInfo{"targets", "m", "where to; default: where the vertex starts"}, self.targets);
  }
};

struct PositionProjection {
  static constexpr std::string_view name = "position";
  static constexpr int vertices = 1;
  static constexpr int rows = 1;
  static constexpr int fields = 3;  // the target
  static constexpr bool translation_invariant = false;
  static constexpr bool has_targets = true;
  static void project(const Real* target, const Real*, Real* p) { std::copy_n(target, 3, p); }
};

/// Vertices that stand exactly at their targets.
class HardPins final : public ConstraintGroup {
 public:
  void add(Index vertex, const Vec3& target);

  std::string_view type() const override { return "position"; }
  GroupShape shape() const override { return {}; }
  std::span<const Index> stencil() const override { return {}; }
  std::span<const Real> reduction() const override { return {}; }
  std::span<const Real> rest_measure() const override { return {}; }
  Real project(const Positions&, std::span<Real>, Index, Index) const override { return 0; }
  std::span<const Index> pinned_vertices() const override { return held_; }
  std::span<Real> targets() override { return targets_; }
  std::unique_ptr<ConstraintGroup> reordered(std::span<const Index> order,
                                             std::span<const Index> numbers) const override;
  void sync_parameters(const ConstraintGroup& from, std::span<const Index> order) override;
  std::unique_ptr<ConstraintGroup> copy() const override { return std::make_unique<HardPins>(*this); }

 private:
  std::vector<Index> held_;
  std::vector<Real> targets_;
};

/// Throws Error(input) on an index out of range or a wrong number of targets.
ConstraintSet build(const BodyView& body, const Position& options);

/// The positions of a set but for those of some vertices, which have the indices of the simulation. Throws Error(input)
/// on constraints of another type, and on a vertex that has none in the set.
ConstraintSet release(const ConstraintSet& positions, std::span<const Index> vertices);

}  // namespace pliant
