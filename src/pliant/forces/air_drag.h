#pragma once
// The drag of the air on triangles, inside the minimization. Each vertex of a triangle of area A and normal n has
//
//     E = ½ (c A/3η) (n·(x − a − η u))²        with the velocity v = (x − a)/η at the end of the step,
//
// whose force is a third of F = c A (n·(u − v)) n. n and A are those at the start of the step, a and η those of the
// integrator (StateView::origin). Source: thesis Sec. 5.3 with drag and units. As an explicit force it would be
// unstable once c A h/m > 2; here it balances every other force exactly, at any time step.
//
// All triangles at a vertex are one constraint: z = x, and with K = Σ A/3 n nᵀ
//
//     E = ½ c/η (x − a − η u)ᵀ K (x − a − η u),        w (p − z) = −c/η K (x − a − η u).
//
// The system matrix has c/η Σ A₀/3 of the areas at rest instead of c/η K, so it stays while normals turn; to remain
// above half of K it takes 1.5 A₀, 2.25 A₀ ... where A has grown beyond 1.5 times that.
#include <vector>

#include "pliant/constraints/constraint_group.h"
#include "pliant/forces/wind.h"
#include "pliant/mesh/mesh.h"

namespace pliant {

/// Triangles with the indices of the simulation.
struct SurfaceTriangles {
  std::vector<Triangle> triangles;
  std::vector<Real> rest_areas;  ///< of each [m²]

  explicit SurfaceTriangles(const ForceScope& scope);
  friend bool operator==(const SurfaceTriangles&, const SurfaceTriangles&) = default;
};

class AirDrag final : public ConstraintGroup {
 public:
  /// Refers to both, which must outlive it; the options may change between steps. drag > 0.
  AirDrag(const SurfaceTriangles& surface, const Wind& options);

  std::string_view type() const override { return Wind::info.name; }
  GroupShape shape() const override { return {static_cast<Index>(vertices_.size()), 1, 1}; }
  std::span<const Index> stencil() const override { return vertices_; }
  std::span<const Real> reduction() const override { return ones_; }
  std::span<const Real> rest_measure() const override { return measure_; }
  bool is_external() override { return true; }

  void begin_step(const StateView& state, Real time_step) override;
  Real project(const Positions& positions, std::span<Real> out, Index begin, Index end) const override;
  void move_guess(Positions& q, std::span<const Real> inertia) const override;
  std::unique_ptr<ConstraintGroup> reordered(std::span<const Index> order,
                                             std::span<const Index> numbers) const override;
  void sync_parameters(const ConstraintGroup& from, std::span<const Index> order) override;

 private:
  AirDrag() = default;
  void gather_areas(const StateView& state);
  void follow_areas();

  const SurfaceTriangles* surface_ = nullptr;  // none in a reordered copy, which takes its numbers from the original
  const Wind* options_ = nullptr;
  std::vector<Index> vertices_;
  std::vector<Real> ones_;
  std::vector<Index> corners_;     // of each triangle, three places in vertices_
  std::vector<Real> rest_shares_;  // Σ A₀/3 of each vertex [m²]
  std::vector<Real> measure_;      // what the system matrix has of it [m²]
  std::vector<Real> shares_;       // Σ A/3 now [m²]
  std::vector<Mat3> matrices_;     // K [m²]
  std::vector<Vec3> centers_;      // a + η u [m]
};

/// The air's velocity at a time [s]: steady, times 1 + gust_strength (0.6 sin φ + 0.4 sin(1.618 φ + 1)), φ = 2π
/// t/period.
Vec3 air_velocity(const Wind& wind, Real time);

/// A [m²] and n of a triangle as the wind meets it: n is zero where the triangle has no area.
struct WindFace {
  Real area = 0;
  Vec3 normal = Vec3::Zero();
};
WindFace wind_face(const SurfaceTriangles& surface, std::size_t triangle, const Positions& positions, WindArea area);

}  // namespace pliant
