#include "pliant/forces/wind.h"

#include <algorithm>
#include <numbers>

namespace pliant {

Wind::Wind(std::vector<Triangle> triangles, std::vector<Real> rest_areas, const WindOptions& options)
    : triangles_(std::move(triangles)), rest_areas_(std::move(rest_areas)), options_(options) {
  check_options("wind", options_);
  if (triangles_.empty()) fail_input("wind: there are no triangles for it to blow on; give it a body that has some");
  if (rest_areas_.size() != triangles_.size())
    fail_input("wind: the rest areas are not as many as the triangles; give one for each");
  Index vertices = 0;
  for (const Triangle& triangle : triangles_) {
    const auto [first, last] = std::ranges::minmax(triangle);
    if (first < 0 || last == std::numeric_limits<Index>::max())
      fail_input("wind: a triangle has a vertex that is not there; mend the triangles");
    vertices = std::max(vertices, last + 1);
  }
  share_.resize(vertices, 3);
  area_.resize(static_cast<std::size_t>(vertices));
}

Vec3 Wind::velocity_at(Real time) const {
  const Real phase = 2 * std::numbers::pi * time / options_.gust_period;
  const Real gust = 0.6 * std::sin(phase) + 0.4 * std::sin(1.618 * phase + 1);
  return (1 + options_.gust_strength * gust) * options_.velocity;
}

void Wind::add_triangle(std::size_t t, const StateView& state, const Vec3& air) {
  const auto [a, b, c] = triangles_[t];
  const Vec3 x0 = row(state.positions, a);
  const Vec3 cross = (row(state.positions, b) - x0).cross(row(state.positions, c) - x0);
  const Real twice_area = cross.stableNorm();
  if (!(twice_area > 0)) return;
  const Vec3 n = cross / twice_area;
  const Real area = options_.area == WindArea::rest ? rest_areas_[t] : twice_area / 2;
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

void Wind::add_to(Positions& forces, const StateView& state, Real time_step) {
  share_.setZero();
  std::ranges::fill(area_, Real(0));
  const Vec3 air = velocity_at(state.time);
  for (std::size_t t = 0; t < triangles_.size(); ++t) add_triangle(t, state, air);
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

std::optional<Index> Wind::vertex_out_of_range(Index vertex_count) const {
  for (const Triangle& triangle : triangles_) {
    for (const Index vertex : triangle) {
      if (vertex < 0 || vertex >= vertex_count) return vertex;
    }
  }
  return std::nullopt;
}

}  // namespace pliant
