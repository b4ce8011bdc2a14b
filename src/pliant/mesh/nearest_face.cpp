#include "pliant/mesh/nearest_face.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace pliant {
namespace {

/// Weights below this are 0: the point is on the edge opposite.
constexpr Real smallest_weight = 1e-9;
/// Sine of an angle below which a triangle is its edges.
constexpr Real flat_sine = 1e-12;

/// Of the edge from corner i to the next.
FacePoint on_edge(const Vec3& place, const std::array<Vec3, 3>& corners, std::size_t i) {
  const std::size_t j = (i + 1) % 3;
  const Vec3 e = corners[j] - corners[i];
  const Real squares = e.squaredNorm();
  Real share = squares > 0 ? std::clamp<Real>((place - corners[i]).dot(e) / squares, 0, 1) : 0;
  if (share < smallest_weight) share = 0;
  if (share > 1 - smallest_weight) share = 1;
  FacePoint point;
  point.weights[i] = 1 - share;
  point.weights[j] = share;
  point.squared = (corners[i] + share * e - place).squaredNorm();
  return point;
}

}  // namespace

FacePoint nearest_point(const Vec3& place, const std::array<Vec3, 3>& corners) {
  const Vec3 e1 = corners[1] - corners[0], e2 = corners[2] - corners[0], w = place - corners[0];
  const Vec3 n = e1.cross(e2);
  const Real squares = n.squaredNorm();
  if (squares > flat_sine * flat_sine * e1.squaredNorm() * e2.squaredNorm()) {
    const Real b1 = w.cross(e2).dot(n) / squares, b2 = e1.cross(w).dot(n) / squares;
    const Real b0 = 1 - b1 - b2;
    if (std::min({b0, b1, b2}) >= smallest_weight) {
      return {-1, {b0, b1, b2}, (b1 * e1 + b2 * e2 - w).squaredNorm()};
    }
  }
  FacePoint best = on_edge(place, corners, 0);
  for (const std::size_t i : {std::size_t{1}, std::size_t{2}}) {
    const FacePoint point = on_edge(place, corners, i);
    if (point.squared < best.squared) best = point;
  }
  return best;
}

NearestFace::NearestFace(const Positions& x, std::span<const Triangle> triangles)
    : x_(x), triangles_(triangles), order_(triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Vec3> centers;
  for (Index t = 0; t < count_of(triangles); ++t) {
    const std::array<Vec3, 3> c = corners(t);
    centers.push_back((c[0] + c[1] + c[2]) / 3);
  }
  if (!order_.empty()) build(centers, 0, order_.size());
}

std::array<Vec3, 3> NearestFace::corners(Index triangle) const {
  const Triangle& t = triangles_[at(triangle)];
  return {row(x_, t[0]), row(x_, t[1]), row(x_, t[2])};
}

void NearestFace::build(std::span<const Vec3> centers, std::size_t begin, std::size_t end) {
  const std::size_t here = nodes_.size();
  const auto place = [this](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  nodes_.push_back({.begin = begin, .end = end});
  Eigen::AlignedBox<Real, 3> of_centers;
  for (std::size_t i = begin; i < end; ++i) {
    of_centers.extend(centers[at(order_[i])]);
    for (const Vec3& corner : corners(order_[i])) nodes_[here].bounds.extend(corner);
  }
  if (end - begin <= largest_leaf) return;
  Index axis = 0;
  of_centers.sizes().maxCoeff(&axis);
  const std::size_t middle = begin + (end - begin) / 2;
  std::ranges::nth_element(place(begin), place(middle), place(end), {},
                           [&](Index t) { return std::pair(centers[at(t)][axis], t); });
  build(centers, begin, middle);
  nodes_[here].second = nodes_.size();
  build(centers, middle, end);
}

FacePoint NearestFace::operator()(const Vec3& place) const {
  FacePoint best;
  best.squared = std::numeric_limits<Real>::infinity();
  if (!nodes_.empty()) search(place, 0, best);
  return best;
}

void NearestFace::search(const Vec3& place, std::size_t node, FacePoint& best) const {
  const Node& here = nodes_[node];
  if (here.bounds.squaredExteriorDistance(place) > best.squared) return;
  if (here.second > 0) {
    const bool first_is_nearer = nodes_[node + 1].bounds.squaredExteriorDistance(place) <=
                                 nodes_[here.second].bounds.squaredExteriorDistance(place);
    search(place, first_is_nearer ? node + 1 : here.second, best);
    search(place, first_is_nearer ? here.second : node + 1, best);
    return;
  }
  for (std::size_t i = here.begin; i < here.end; ++i) {
    const Index t = order_[i];
    FacePoint point = nearest_point(place, corners(t));
    if (point.squared < best.squared || (point.squared == best.squared && (best.triangle < 0 || t < best.triangle))) {
      best = point;
      best.triangle = t;
    }
  }
}

}  // namespace pliant
