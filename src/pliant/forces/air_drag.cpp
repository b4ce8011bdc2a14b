#include "pliant/forces/air_drag.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include <Eigen/Cholesky>

#include "pliant/constraints/reorder.h"
#include "pliant/mesh/geometry.h"

namespace pliant {
namespace {

/// How far the areas may exceed those in the system matrix, which must stay above half of what it stands for.
constexpr Real largest_growth = 1.5;
/// Of a vertex whose triangles have no area at rest [m²]: the system matrix needs some.
constexpr Real least_share = 1e-100;

}  // namespace

SurfaceTriangles::SurfaceTriangles(const ForceScope& scope) {
  for (const ForceBody& body : scope.bodies) {
    for (const Triangle& t : body.rest.triangles) {
      triangles.push_back({body.first_vertex + t[0], body.first_vertex + t[1], body.first_vertex + t[2]});
    }
    const std::vector<Real> more = triangle_areas(body.rest.vertices, body.rest.triangles);
    rest_areas.insert(rest_areas.end(), more.begin(), more.end());
  }
}

Vec3 air_velocity(const Wind& wind, Real time) {
  const Real phase = 2 * std::numbers::pi * time / wind.gust_period;
  const Real gust = 0.6 * std::sin(phase) + 0.4 * std::sin(1.618 * phase + 1);
  return (1 + wind.gust_strength * gust) * wind.velocity;
}

WindFace wind_face(const SurfaceTriangles& surface, std::size_t triangle, const Positions& positions, WindArea area) {
  const auto [a, b, c] = surface.triangles[triangle];
  const Vec3 x0 = row(positions, a);
  const Vec3 cross = (row(positions, b) - x0).cross(row(positions, c) - x0);
  const Real twice_area = cross.stableNorm();
  if (!(twice_area > 0)) return {};
  return {area == WindArea::rest ? surface.rest_areas[triangle] : twice_area / 2, cross / twice_area};
}

AirDrag::AirDrag(const SurfaceTriangles& surface, const Wind& options) : surface_(&surface), options_(&options) {
  for (const Triangle& triangle : surface.triangles) {
    for (const Index vertex : triangle) vertices_.push_back(vertex);
  }
  std::ranges::sort(vertices_);
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  ones_.assign(vertices_.size(), 1);
  rest_shares_.assign(vertices_.size(), 0);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    for (const Index vertex : surface.triangles[t]) {
      const auto place = std::ranges::lower_bound(vertices_, vertex) - vertices_.begin();
      corners_.push_back(static_cast<Index>(place));
      rest_shares_[static_cast<std::size_t>(place)] += surface.rest_areas[t] / 3;
    }
  }
  const Real mean =
      std::accumulate(rest_shares_.begin(), rest_shares_.end(), Real(0)) / static_cast<Real>(ones_.size());
  for (Real& share : rest_shares_)
    share = std::max({share, 1e-9 * mean, least_share});  // of triangles without area at rest
  measure_ = rest_shares_;
  shares_.assign(vertices_.size(), 0);
  matrices_.assign(vertices_.size(), Mat3::Zero());
  centers_.assign(vertices_.size(), Vec3::Zero());
}

void AirDrag::begin_step(const StateView& state, Real time_step) {
  const Real step = state.inertia_step > 0 ? state.inertia_step : time_step;
  // A step too short for the quotient ends as one too short for m/h² does, with the same message.
  set_stiffness(std::min(options_->drag / step, std::numeric_limits<Real>::max()));
  gather_areas(state);
  const Vec3 way = step * air_velocity(*options_, state.time);
  for (std::size_t i = 0; i < vertices_.size(); ++i) centers_[i] = state.origin(vertices_[i]) + way;
  follow_areas();
}

void AirDrag::gather_areas(const StateView& state) {
  std::ranges::fill(shares_, Real(0));
  for (Mat3& matrix : matrices_) matrix.setZero();
  for (std::size_t t = 0; t < surface_->triangles.size(); ++t) {
    const WindFace face = wind_face(*surface_, t, state.positions, options_->area);
    const Mat3 matrix = face.area / 3 * face.normal * face.normal.transpose();
    for (std::size_t corner = 3 * t; corner < 3 * t + 3; ++corner) {
      const auto i = static_cast<std::size_t>(corners_[corner]);
      matrices_[i] += matrix;
      shares_[i] += face.area / 3;
    }
  }
}

/// A function of the areas of now alone, so that a resumed run has the same system matrix.
void AirDrag::follow_areas() {
  bool has_changed = false;
  for (std::size_t i = 0; i < measure_.size(); ++i) {
    Real measure = rest_shares_[i];
    const Real growth = shares_[i] / measure;
    if (growth > largest_growth && std::isfinite(growth)) {
      measure *= std::pow(largest_growth, std::ceil(std::log(growth) / std::log(largest_growth)) - 1);
    }
    has_changed = has_changed || measure != measure_[i];
    measure_[i] = measure;
  }
  if (has_changed) changed();
}

Real AirDrag::project(const Positions& positions, std::span<Real> out, Index begin, Index end) const {
  Real energy = 0;
  for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i, out = out.subspan(3)) {
    const Vec3 d = row(positions, vertices_[i]) - centers_[i];
    const Vec3 force = -stiffness() * (matrices_[i] * d);
    std::copy_n(force.data(), 3, out.data());
    energy -= force.dot(d) / 2;
  }
  return energy;
}

/// (M/η² + c/η K) x = −c/η K (s − a − η u), solved at each vertex alone.
void AirDrag::move_guess(Positions& q, std::span<const Real> inertia) const {
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const Real weight = inertia[static_cast<std::size_t>(vertices_[i])];
    if (!(weight > 0)) continue;
    const Mat3 K = stiffness() / weight * matrices_[i];
    const Vec3 x = (Mat3::Identity() + K).llt().solve(K * (centers_[i] - row(q, vertices_[i])));
    if (x.allFinite()) q.row(vertices_[i]) += x.transpose();
  }
}

std::unique_ptr<ConstraintGroup> AirDrag::reordered(std::span<const Index> order,
                                                    std::span<const Index> numbers) const {
  std::unique_ptr<AirDrag> copy(new AirDrag());
  copy->vertices_ = in_order(stencil(), order, 1);
  for (Index& vertex : copy->vertices_) vertex = numbers[static_cast<std::size_t>(vertex)];
  copy->ones_ = ones_;
  copy->measure_ = in_order(rest_measure(), order, 1);
  copy->matrices_.resize(matrices_.size());
  copy->centers_.resize(centers_.size());
  copy->sync_parameters(*this, order);
  return copy;
}

void AirDrag::sync_parameters(const ConstraintGroup& from, std::span<const Index> order) {
  ConstraintGroup::sync_parameters(from, order);
  const auto& original = dynamic_cast<const AirDrag&>(from);
  take_in_order(std::span<const Mat3>(original.matrices_), order, 1, std::span<Mat3>(matrices_));
  take_in_order(std::span<const Vec3>(original.centers_), order, 1, std::span<Vec3>(centers_));
}

}  // namespace pliant
