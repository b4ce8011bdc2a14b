#pragma once
// Projections of curvature vectors, shared by `bending`, `hinge` and `triangle_bending`: all keep the length of z.
#include <cmath>
#include <map>

#include "pliant/constraints/batch.h"
#include "pliant/constraints/bending.h"

namespace pliant {

/// Flat at rest: p = 0.
struct FlatCurvature {
  static constexpr std::string_view name = "bending";
  static constexpr int vertices = dynamic_vertices;
  static constexpr int rows = 1;
  static constexpr int fields = 0;
  static constexpr bool translation_invariant = true;
  static constexpr bool rotation_invariant = true;
  static constexpr bool is_linear = true;
  static constexpr auto kernel = &LocalKernels::flat_curvature;
  static void project(const Real*, const Real*, Real* p) { std::fill_n(p, 3, Real(0)); }
};

/// Curved at rest, magnitudes only.
struct AbsoluteCurvature {
  static constexpr std::string_view name = "bending";
  static constexpr int vertices = dynamic_vertices;
  static constexpr int rows = 1;
  static constexpr int fields = 4;  // ‖z_g‖, z_g
  static constexpr bool translation_invariant = true;
  static constexpr bool rotation_invariant = true;
  static constexpr auto kernel = &LocalKernels::absolute_curvature;
  static void project(const Real* field, const Real* z, Real* p);
};

/// Curved at rest, on the side of the surface where it was. The normal is frozen at the start of a step.
template <Vec3 (*normal)(const Positions&, std::span<const Index>)>
struct SignedCurvature {
  static constexpr std::string_view name = "bending";
  static constexpr int vertices = dynamic_vertices;
  static constexpr int rows = 1;
  static constexpr int fields = 8;  // ‖z_g‖, z_g, σ, n
  static constexpr bool translation_invariant = true;
  static constexpr auto kernel = &LocalKernels::signed_curvature;
  static void project(const Real* field, const Real* z, Real* p);
  static void begin_step(const Positions& positions, std::span<const Index> stencil, Real* field) {
    const Vec3 n = normal(positions, stencil);
    std::copy_n(n.data(), 3, field + 5);
  }
};

/// Unit normal of a closed fan (center, neighbors in cyclic order); zero where it has none.
Vec3 fan_normal(const Positions& positions, std::span<const Index> stencil);
/// Unit normal of the triangles x₀ x₁ x₂ and x₁ x₀ x₃ together; zero where they have none.
Vec3 hinge_normal(const Positions& positions, std::span<const Index> stencil);

/// Unit normal of the triangle of the first three vertices; zero where it has none.
Vec3 corner_normal(const Positions& positions, std::span<const Index> stencil);

using SignedFanCurvature = SignedCurvature<fan_normal>;
using SignedHingeCurvature = SignedCurvature<hinge_normal>;
using SignedTriangleCurvature = SignedCurvature<corner_normal>;

/// Sorts curvature constraints into batches: one for each size of stencil, flat and curved apart.
template <class Signed>
class CurvatureBatches {
 public:
  CurvatureBatches(std::string_view type, const BodyView& body, Orientation orientation, Real stiffness)
      : type_(type), body_(body), orientation_(orientation), stiffness_(stiffness) {}

  /// `stencil` within the body; the coefficients sum to zero.
  void add(std::span<const Index> stencil, std::span<const Real> coefficients, Real measure) {
    add(stencil, coefficients, measure, orientation_);
  }
  /// The same, of an orientation of its own.
  void add(std::span<const Index> stencil, std::span<const Real> coefficients, Real measure, Orientation orientation);
  ConstraintSet take();

 private:
  struct BatchesOfSize {
    std::unique_ptr<Batch<FlatCurvature>> flat;
    std::unique_ptr<Batch<AbsoluteCurvature>> absolute;
    std::unique_ptr<Batch<Signed>> with_sign;
  };
  template <class Type>
  Batch<Type>& batch(std::unique_ptr<Batch<Type>>& slot, std::size_t vertices) {
    if (!slot) slot = std::make_unique<Batch<Type>>(stiffness_, static_cast<int>(vertices), type_);
    return *slot;
  }

  std::string_view type_;  // of the constraints, for people
  const BodyView& body_;
  Orientation orientation_;
  Real stiffness_;
  std::map<std::size_t, BatchesOfSize> batches_;
};

}  // namespace pliant
