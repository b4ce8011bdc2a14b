#include "pliant/collision/detail/fan.h"

#include <algorithm>

#include "pliant/collision/exact_orientation.h"

namespace pliant::collision {

namespace {

/// Whether each end of a line is one of an even number of lines.
bool is_closed(const FanRing& ring) {
  const auto comes_before = [](const Vec3& a, const Vec3& b) { return std::ranges::lexicographical_compare(a, b); };
  std::vector<Vec3> ends;
  for (const auto& line : ring) ends.insert(ends.end(), line.begin(), line.end());
  std::ranges::sort(ends, comes_before);
  for (std::size_t first = 0; first < ends.size();) {
    std::size_t next = first;
    while (next < ends.size() && ends[next] == ends[first]) ++next;
    if ((next - first) % 2 != 0) return false;
    first = next;
  }
  return !ring.empty();
}

/// Ways from a point to the reference, counted by how often they pass through the fan.
class FanSides {
 public:
  FanSides(const Vec3& x, const FanRing& ring, const Vec3& reference) : x_(x), ring_(ring), reference_(reference) {
    for (const auto& [u, v] : ring) turns_.push_back(orientation(x, u, v, reference));
  }

  /// Whether the reference is in no plane of the fan.
  bool is_usable() const {
    return std::ranges::none_of(turns_, [](int turn) { return turn == 0; });
  }

  /// None if x lies on the line from q to the reference.
  std::optional<int> side_of(const Vec3& q) const {
    bool is_same_side = true;
    bool is_in_line = true;
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      const auto& [u, v] = ring_[i];
      const int turn = turns_[i];
      const int side = orientation(x_, u, v, q);
      const int turn_u = orientation(x_, u, q, reference_);
      const int turn_v = orientation(x_, v, q, reference_);
      is_in_line = is_in_line && turn_u == 0 && turn_v == 0;
      if (side == 0 && turn_u * turn >= 0 && turn_v * turn <= 0) return 0;
      // The way from q to the reference passes between the rays from x through u and v. One that passes exactly through
      // a ray is taken a little to one side of it, the same for both triangles there.
      const bool passes_between = (turn_u >= 0) == (turn > 0) && (turn_v < 0) == (turn > 0);
      if (side * turn < 0 && passes_between) is_same_side = !is_same_side;
    }
    if (is_in_line) return {};
    return is_same_side ? 1 : -1;
  }

 private:
  const Vec3& x_;
  const FanRing& ring_;
  const Vec3& reference_;
  std::vector<int> turns_;
};

/// How far the ring reaches from x, or x from the origin: a step that is not lost in rounding.
Real step_size(const Vec3& x, const FanRing& ring) {
  Real size = x.cwiseAbs().maxCoeff();
  for (const auto& [u, v] : ring) size = std::max({size, (u - x).cwiseAbs().maxCoeff(), (v - x).cwiseAbs().maxCoeff()});
  return size;
}

}  // namespace

std::optional<Vec3> point_off_plane(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Real size = std::max({a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff(), c.cwiseAbs().maxCoeff()});
  if (size == 0) return {};
  Eigen::Index first_axis = 0;
  (((b - a) / size).cross((c - a) / size)).cwiseAbs().maxCoeff(&first_axis);
  for (Eigen::Index i = 0; i < 3; ++i) {
    Vec3 point = a;
    point[(first_axis + i) % 3] += size;
    if (orientation(a, b, c, point) != 0) return point;
  }
  return {};
}

std::vector<int> sides_of_fan(const Vec3& x, const FanRing& ring, const std::vector<Vec3>& points) {
  const std::vector<int> none(points.size(), 0);
  if (!is_closed(ring)) return none;
  // Directions that no mesh is likely to have; one that a fan does have is passed over.
  const Real size = step_size(x, ring);
  for (const Vec3& direction : {Vec3(0.61, 0.37, 0.71), Vec3(-0.53, 0.79, 0.31), Vec3(0.29, -0.83, 0.47),
                                Vec3(0.43, 0.59, -0.67), Vec3(-0.73, -0.41, -0.23), Vec3(0.19, 0.13, 0.97)}) {
    const Vec3 reference = x + size * direction;
    const FanSides fan(x, ring, reference);
    if (!fan.is_usable()) continue;
    std::vector<int> sides;
    for (const Vec3& point : points) {
      const std::optional<int> side = fan.side_of(point);
      if (!side) break;
      sides.push_back(*side);
    }
    if (sides.size() == points.size()) return sides;
  }
  return none;
}

}  // namespace pliant::collision
