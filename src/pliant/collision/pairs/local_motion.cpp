#include "pliant/collision/pairs/local_motion.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace pliant {

using collision::boxes_side_by_side;
using collision::EightBoxes;
using collision::FloatBox;

namespace {

constexpr std::size_t vertices_of_region = 16;
/// Of r: how far apart regions are that are looked at.
constexpr Real reach_of_regions = 8;
/// Of each region in the mean: with more neighbors than that nothing is won.
constexpr std::size_t most_neighbors = 64;
/// Of a distance: what may be taken of it.
constexpr Real most_taken = 0.9;

std::size_t groups_for(std::size_t boxes) {
  return (boxes + boxes_side_by_side - 1) / boxes_side_by_side;
}

}  // namespace

void LocalMotion::Box::add(const Real* point) {
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = std::min(low[i], point[i]);
    high[i] = std::max(high[i], point[i]);
  }
}

FloatBox LocalMotion::Box::larger_by(Real pad) const {
  FloatBox box{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    box.low[axis] = collision::rounded_down(low[i] - pad);
    box.high[axis] = collision::rounded_up(high[i] + pad);
  }
  return box;
}

void LocalMotion::set_surface(const Surface& surface, const Positions& rest, std::span<const Real> radii) {
  is_begun_ = false;
  region_count_ = 0;
  region_of_vertex_.assign(surface.body.size(), -1);
  std::vector<Index> vertices = surface.vertices;
  std::ranges::stable_sort(vertices, {}, [&](Index v) { return surface.body[at(v)]; });
  for (auto first = vertices.begin(); first != vertices.end();) {
    const Index body = surface.body[at(*first)];
    const auto last = std::find_if(first, vertices.end(), [&](Index v) { return surface.body[at(v)] != body; });
    split({first, last}, rest);
    first = last;
  }
  add_corners(surface);
  radii_.assign(region_count_, std::numeric_limits<Real>::infinity());
  largest_radius_ = 0;
  for_each_region([&](std::size_t region, Index v) {
    radii_[region] = std::min(radii_[region], radii[at(v)]);
    largest_radius_ = std::max(largest_radius_, radii[at(v)]);
  });
}

/// By halving, along the axis on which they lie farthest apart.
void LocalMotion::split(std::span<Index> vertices, const Positions& rest) {
  if (vertices.size() <= vertices_of_region) {
    for (const Index v : vertices) region_of_vertex_[at(v)] = static_cast<Index>(region_count_);
    ++region_count_;
    return;
  }
  Vec3 low = row(rest, vertices.front()), high = low;
  for (const Index v : vertices) {
    low = low.cwiseMin(row(rest, v));
    high = high.cwiseMax(row(rest, v));
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::size_t half = vertices.size() / 2;
  std::ranges::nth_element(vertices, vertices.begin() + static_cast<std::ptrdiff_t>(half), [&](Index a, Index b) {
    return rest(a, axis) != rest(b, axis) ? rest(a, axis) < rest(b, axis) : a < b;
  });
  split(vertices.first(half), rest);
  split(vertices.subspan(half), rest);
}

/// A feature is of the region of its first corner.
void LocalMotion::add_corners(const Surface& surface) {
  std::vector<std::vector<Index>> corners(region_count_);
  const auto add = [&](std::span<const Index> feature) {
    std::vector<Index>& region = corners[at(region_of_vertex_[at(feature.front())])];
    region.insert(region.end(), feature.begin(), feature.end());
  };
  for (const Index v : surface.vertices) add({&v, 1});
  for (const Edge& each : surface.edges) add(each);
  for (const Triangle& each : surface.triangles) add(each);
  begin_.assign(1, 0);
  corners_.clear();
  for (std::vector<Index>& of_region : corners) {
    std::ranges::sort(of_region);
    of_region.erase(std::unique(of_region.begin(), of_region.end()), of_region.end());
    corners_.insert(corners_.end(), of_region.begin(), of_region.end());
    begin_.push_back(corners_.size());
  }
}

/// Calls visit(region, corner).
template <class Visit>
void LocalMotion::for_each_region(Visit&& visit) const {
  for (std::size_t region = 0; region < region_count_; ++region) {
    for (std::size_t i = begin_[region]; i < begin_[region + 1]; ++i) visit(region, corners_[i]);
  }
}

Real LocalMotion::distance(const Box& a, const Box& b) {
  Real sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Real apart = std::max({a.low[i] - b.high[i], b.low[i] - a.high[i], Real(0)});
    sum += apart * apart;
  }
  return std::sqrt(sum);
}

Real LocalMotion::squared_difference(const Box& a, const Box& b) {
  Real sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Real most = std::max(a.high[i] - b.low[i], b.high[i] - a.low[i]);
    sum += most * most;
  }
  return sum;
}

void LocalMotion::begin(const Positions& reference) {
  constexpr Real none = std::numeric_limits<Real>::infinity();
  is_begun_ = true;
  boxes_.assign(region_count_, {{none, none, none}, {-none, -none, -none}});
  for_each_region([&](std::size_t region, Index v) { boxes_[region].add(reference.data() + 3 * v); });
  set_groups();
  neighbors_.clear();
  are_too_many_ = false;
  for (std::size_t a = 0; a < groups_.size() && !are_too_many_; ++a) {
    const EightBoxes& hulls = hulls_[a / boxes_side_by_side];
    for (std::size_t b = a / boxes_side_by_side; b < hulls_.size(); ++b) {
      unsigned bits = meeting_row(hulls, a % boxes_side_by_side, hulls_[b]);
      for (; bits != 0; bits &= bits - 1) {
        const std::size_t group = boxes_side_by_side * b + static_cast<std::size_t>(std::countr_zero(bits));
        if (group >= a) add_neighbors(a, group);
      }
    }
    are_too_many_ = neighbors_.size() > most_neighbors * region_count_;
  }
}

/// Regions that come one after another lie together, since they were halved.
void LocalMotion::set_groups() {
  groups_.resize(groups_for(region_count_));
  hulls_.resize(groups_for(groups_.size()));
  for (std::size_t i = 0; i < boxes_side_by_side * groups_.size(); ++i) {
    EightBoxes& group = groups_[i / boxes_side_by_side];
    if (i < region_count_) {
      group.set(i % boxes_side_by_side, boxes_[i].larger_by(reach_of_regions / 2 * largest_radius_));
    } else {
      group.set_empty(i % boxes_side_by_side);
    }
  }
  for (std::size_t i = 0; i < boxes_side_by_side * hulls_.size(); ++i) {
    EightBoxes& group = hulls_[i / boxes_side_by_side];
    if (i < groups_.size()) {
      group.set(i % boxes_side_by_side, groups_[i].hull());
    } else {
      group.set_empty(i % boxes_side_by_side);
    }
  }
}

void LocalMotion::add_neighbors(std::size_t group_a, std::size_t group_b) {
  for (std::size_t i = 0; i < boxes_side_by_side; ++i) {
    unsigned bits = meeting_row(groups_[group_a], i, groups_[group_b]);
    const std::size_t a = boxes_side_by_side * group_a + i;
    for (; bits != 0; bits &= bits - 1) {
      const std::size_t b = boxes_side_by_side * group_b + static_cast<std::size_t>(std::countr_zero(bits));
      if (b >= a) neighbors_.push_back({a, b, (radii_[a] + radii_[b]) / 2, distance(boxes_[a], boxes_[b])});
    }
  }
}

/// Of distances d ≥ 2 r, at least D between two regions, max(r, D − r) may be lost so that r is left, and
/// 0.9 max(2 r, D) so that something is.
LocalMotion::Kept LocalMotion::kept(const Positions& reference, const Positions& q, Real farthest) {
  if (!(2 * farthest < most_taken * reach_of_regions * largest_radius_)) return {};
  if (!is_begun_) begin(reference);
  if (are_too_many_) return {};
  constexpr Real none = std::numeric_limits<Real>::infinity();
  boxes_.assign(region_count_, {{none, none, none}, {-none, -none, -none}});
  Real sum = 0;  // no number where a way is none, which boxes do not tell
  for_each_region([&](std::size_t region, Index v) {
    const Real* const from = reference.data() + 3 * v;
    const Real* const to = q.data() + 3 * v;
    const std::array<Real, 3> way{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    boxes_[region].add(way.data());
    sum += way[0] + way[1] + way[2];
  });
  Kept result{2 * farthest < (reach_of_regions - 1) * largest_radius_, std::isfinite(sum)};
  result.is_radius &= result.is_some;
  for (const Neighbors& each : neighbors_) {
    const Real taken = squared_difference(boxes_[each.a], boxes_[each.b]);
    const Real most = most_taken * std::max(2 * each.radius, each.distance);
    const Real most_of_radius = std::max(each.radius, each.distance - largest_radius_);
    if (!(taken < most * most)) return {};
    result.is_radius &= taken < most_of_radius * most_of_radius;
  }
  return result;
}

}  // namespace pliant
