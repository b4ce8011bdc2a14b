#include "pliant/forces/wind.h"

#include <algorithm>
#include <numbers>

#include "pliant/mesh/geometry.h"

namespace pliant {
namespace {

/// Triangles of bodies with the indices of the simulation, and their areas at rest [m²].
struct SurfaceTriangles {
  std::vector<Triangle> triangles;
  std::vector<Real> rest_areas;

  explicit SurfaceTriangles(const ForceScope& scope) {
    for (const ForceBody& body : scope.bodies) {
      for (const Triangle& t : body.rest.triangles) {
        triangles.push_back({body.first_vertex + t[0], body.first_vertex + t[1], body.first_vertex + t[2]});
      }
      const std::vector<Real> more = triangle_areas(body.rest.vertices, body.rest.triangles);
      rest_areas.insert(rest_areas.end(), more.begin(), more.end());
    }
  }
};

class WindForce final : public Force {
 public:
  WindForce(SurfaceTriangles surface, const Wind& options);

  std::string_view type() const override { return Wind::info.name; }
  std::string remedy() const override { return "reduce it, or give it `area` `rest` or the model `relative`"; }

  /// `relative` is evaluated at vₙ, which alone would overshoot once x = h c ΣA/(3m) passes 2; each vertex' share is
  /// therefore scaled by (1 − e⁻ˣ)/x: the exact decay of a vertex that only the wind acts on.
  void add_to(Positions& forces, const StateView& state, Real time_step) override;
  std::optional<Index> vertex_out_of_range(Index vertex_count) const override;

 private:
  /// The air's velocity at a time: steady, times 1 + gust_strength (0.6 sin φ + 0.4 sin(1.618 φ + 1)), φ = 2π t/period.
  Vec3 velocity_at(Real time) const;

  /// Adds the force of triangle t to share_, and a third of its area to area_, at its vertices.
  void add_triangle(std::size_t t, const StateView& state, const Vec3& air);

  SurfaceTriangles surface_;
  Positions share_;         // scratch: this wind's force on each vertex
  std::vector<Real> area_;  // scratch: a third of the area of the triangles at each vertex
  Wind options_;
};

WindForce::WindForce(SurfaceTriangles surface, const Wind& options) : surface_(std::move(surface)), options_(options) {
  Index vertices = 0;
  for (const Triangle& triangle : surface_.triangles) vertices = std::max(vertices, std::ranges::max(triangle) + 1);
  share_.resize(vertices, 3);
  area_.resize(static_cast<std::size_t>(vertices));
}

Vec3 WindForce::velocity_at(Real time) const {
  const Real phase = 2 * std::numbers::pi * time / options_.gust_period;
  const Real gust = 0.6 * std::sin(phase) + 0.4 * std::sin(1.618 * phase + 1);
  return (1 + options_.gust_strength * gust) * options_.velocity;
}

void WindForce::add_triangle(std::size_t t, const StateView& state, const Vec3& air) {
  const auto [a, b, c] = surface_.triangles[t];
  const Vec3 x0 = row(state.positions, a);
  const Vec3 cross = (row(state.positions, b) - x0).cross(row(state.positions, c) - x0);
  const Real twice_area = cross.stableNorm();
  if (!(twice_area > 0)) return;
  const Vec3 n = cross / twice_area;
  const Real area = options_.area == WindArea::rest ? surface_.rest_areas[t] : twice_area / 2;
  Vec3 force;
  if (options_.model == WindModel::thesis) {
    force = area * n.dot(air) * n;
  } else {
    const Vec3 v = (state.velocities.row(a) + state.velocities.row(b) + state.velocities.row(c)).transpose() / 3;
    force = options_.drag * area * n.dot(air - v) * n;
  }
  for (const Index vertex : {a, b, c}) {
    share_.row(vertex) += force.transpose() / 3;
    area_[static_cast<std::size_t>(vertex)] += area / 3;
  }
}

void WindForce::add_to(Positions& forces, const StateView& state, Real time_step) {
  share_.setZero();
  std::ranges::fill(area_, Real(0));
  const Vec3 air = velocity_at(state.time);
  for (std::size_t t = 0; t < surface_.triangles.size(); ++t) add_triangle(t, state, air);
  for (Index i = 0; i < share_.rows(); ++i) {
    Real scale = 1;
    if (options_.model == WindModel::relative) {
      const auto v = static_cast<std::size_t>(i);
      const Real x = time_step * options_.drag * area_[v] / state.masses[v];
      if (x > 0) scale = -std::expm1(-x) / x;
    }
    forces.row(i) += scale * share_.row(i);
  }
}

std::optional<Index> WindForce::vertex_out_of_range(Index vertex_count) const {
  for (const Triangle& triangle : surface_.triangles) {
    for (const Index vertex : triangle) {
      if (vertex < 0 || vertex >= vertex_count) return vertex;
    }
  }
  return std::nullopt;
}

}  // namespace

std::unique_ptr<Force> build(const ForceScope& scope, const Wind& options) {
  check_options(Wind::info.name, options);
  SurfaceTriangles surface(scope);
  if (surface.triangles.empty()) {
    fail_input("wind: there are no triangles for it to blow on; give it a body that has some");
  }
  return std::make_unique<WindForce>(std::move(surface), options);
}

}  // namespace pliant
