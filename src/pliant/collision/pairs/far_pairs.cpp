#include "pliant/collision/pairs/far_pairs.h"

#include <algorithm>
#include <cmath>

#include "pliant/collision/pairs/eight_boxes.h"

namespace pliant {
namespace {

using collision::four_of;
using collision::FourFloats;
using collision::larger;
using collision::smaller;
using FourMasks = decltype(FourFloats{} < FourFloats{});

constexpr std::size_t lanes = 4;

/// Of the size of two features: what rounding adds to their distance, at most. So much it is where edges are almost
/// parallel, and less elsewhere.
constexpr float uncertain_share = 3e-3F;
/// Squared sine of the angle below which edges are taken for parallel ones.
constexpr float parallel_angle_squared = 1e-6F;

FourFloats to_unit(FourFloats x) {
  const FourFloats zero{}, one = four_of(1.0F);
  const FourFloats above = x > zero ? x : zero;
  return above < one ? above : one;
}

/// A vector in each lane.
struct FourVectors {
  FourFloats x, y, z;

  friend FourVectors operator-(const FourVectors& a, const FourVectors& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  /// a + s b
  static FourVectors sum(const FourVectors& a, FourFloats s, const FourVectors& b) {
    return {a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
  }
  FourVectors times(FourFloats s) const { return {s * x, s * y, s * z}; }
  FourFloats dot(const FourVectors& b) const { return x * b.x + y * b.y + z * b.z; }
  FourFloats squared() const { return dot(*this); }
  FourVectors cross(const FourVectors& b) const { return {y * b.z - z * b.y, z * b.x - x * b.z, x * b.y - y * b.x}; }
};

/// From the origin to the segment from a to b.
FourFloats squared_distance_of_segment(const FourVectors& a, const FourVectors& b) {
  const FourVectors edge = b - a;
  const FourFloats share = to_unit(-a.dot(edge) / edge.squared());
  return FourVectors::sum(a, share, edge).squared();
}

/// From the origin to a triangle.
FourFloats squared_distance_of_triangle(const FourVectors& a, const FourVectors& b, const FourVectors& c) {
  const FourFloats of_border = smaller(smaller(squared_distance_of_segment(a, b), squared_distance_of_segment(b, c)),
                                       squared_distance_of_segment(c, a));
  const FourVectors normal = (b - a).cross(c - a);
  const FourFloats zero{};
  const FourMasks is_inside =
      (normal.dot(b.cross(c)) > zero) & (normal.dot(c.cross(a)) > zero) & (normal.dot(a.cross(b)) > zero);
  const FourFloats height = a.dot(normal);
  return is_inside ? smaller(height * height / normal.squared(), of_border) : of_border;
}

/// From the segment that leads from the origin to a to the one from b to c. Minima along one of them and along the
/// other in turns: the first ones are those of the lines.
FourFloats squared_distance_of_edges(const FourVectors& a, const FourVectors& b, const FourVectors& c) {
  const FourVectors second = c - b;
  const FourFloats aa = a.squared(), ss = second.squared(), as = a.dot(second);
  const FourFloats ab = a.dot(b), sb = second.dot(b);
  const FourFloats sine = aa * ss - as * as;
  const FourFloats on_line = to_unit((ab * ss - as * sb) / sine);
  const FourFloats zero{};
  FourFloats on_first = sine > four_of(parallel_angle_squared) * aa * ss ? on_line : zero;
  const FourFloats on_second = to_unit((on_first * as - sb) / ss);
  on_first = to_unit((on_second * as + ab) / aa);
  const FourVectors there = FourVectors::sum(b, on_second, second);
  return FourVectors::sum(there, -on_first, a).squared();
}

}  // namespace

/// Four pairs, seen from the first vertex of each.
struct FarPairs::Four {
  std::array<collision::ThreeColumns, 3> corners;
  FourFloats reach{};

  void set(const Positions& q, const std::array<std::array<Index, 4>, lanes>& vertices) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto from_first = [&](std::size_t lane) {
        const Real* const first = q.data() + 3 * vertices[lane][0];
        const Real* const corner = q.data() + 3 * vertices[lane][c + 1];
        const auto number = [&](std::size_t axis) { return static_cast<float>(corner[axis] - first[axis]); };
        return FourFloats{number(0), number(1), number(2), 0};
      };
      corners[c] = collision::columns_of(from_first(0), from_first(1), from_first(2), from_first(3));
    }
  }
  /// A bit for each that is far; none where something is not a number.
  template <PairKind kind>
  unsigned far() const {
    const auto corner = [&](std::size_t i) {
      return FourVectors{corners[i].first, corners[i].second, corners[i].third};
    };
    FourVectors a = corner(0), b = corner(1), c = corner(2);
    const FourFloats squared_size = larger(larger(a.squared(), b.squared()), c.squared());
    std::array<float, lanes> size;
    for (std::size_t i = 0; i < lanes; ++i) size[i] = std::sqrt(squared_size[i]);
    const FourFloats scale = four_of(1.0F) / collision::four_at(size.data());
    a = a.times(scale), b = b.times(scale), c = c.times(scale);  // so that products stay in the range of floats
    FourFloats squared;
    if constexpr (kind == PairKind::edge_edge) {
      squared = squared_distance_of_edges(a, b, c);
    } else if constexpr (kind == PairKind::vertex_triangle) {
      squared = squared_distance_of_triangle(a, b, c);
    } else {
      squared = squared_distance_of_segment(a, b);
    }
    const FourFloats most = reach * scale * four_of(1 + uncertain_share) + four_of(uncertain_share);
    return collision::bits_of(squared > most * most);
  }
};

template <PairKind kind>
std::size_t FarPairs::drop_far(std::span<Items> pairs) const {
  const auto vertices_of = [&](const Items& items) -> std::array<Index, 4> {
    if constexpr (kind == PairKind::edge_edge) {
      const auto& [a, b] = surface_->edges[at(items.first)];
      const auto& [c, d] = surface_->edges[at(items.second)];
      return {a, b, c, d};
    } else if constexpr (kind == PairKind::vertex_triangle) {
      const auto& [a, b, c] = surface_->triangles[at(items.second)];
      return {surface_->vertices[at(items.first)], a, b, c};
    } else {
      const auto& [a, b] = surface_->edges[at(surface_->loose_begin + items.second)];
      return {surface_->vertices[at(items.first)], a, b, b};
    }
  };
  constexpr std::size_t second_side = kind == PairKind::edge_edge ? 2 : 1;
  const auto reach_of = [&](const std::array<Index, 4>& vertices) {
    Real first = 0, second = 0;
    for (std::size_t j = 0; j < 4; ++j) {
      Real& side = j < second_side ? first : second;
      side = std::max(side, reach_[at(vertices[j])]);
    }
    return static_cast<float>(first + second);
  };
  std::size_t kept = 0;
  Four four;
  std::array<std::array<Index, 4>, lanes> vertices;
  for (std::size_t i = 0; i < pairs.size(); i += lanes) {
    const std::size_t count = std::min(lanes, pairs.size() - i);
    for (std::size_t lane = 0; lane < lanes; ++lane) vertices[lane] = vertices_of(pairs[i + std::min(lane, count - 1)]);
    four.set(*q_, vertices);
    four.reach = FourFloats{reach_of(vertices[0]), reach_of(vertices[1]), reach_of(vertices[2]), reach_of(vertices[3])};
    const unsigned far = four.far<kind>();
    for (std::size_t lane = 0; lane < count; ++lane) {
      if ((far >> lane & 1U) == 0) pairs[kept++] = pairs[i + lane];
    }
  }
  return kept;
}

std::size_t FarPairs::drop(PairKind kind, std::span<Items> pairs) const {
  switch (kind) {
    case PairKind::vertex_triangle:
      return drop_far<PairKind::vertex_triangle>(pairs);
    case PairKind::edge_edge:
      return drop_far<PairKind::edge_edge>(pairs);
    case PairKind::vertex_edge:
      break;
  }
  return drop_far<PairKind::vertex_edge>(pairs);
}

}  // namespace pliant
