#include "pliant/collision/pairs/gap.h"

#include <algorithm>
#include <cmath>

namespace pliant {
namespace {

/// Squared sine of an angle below which the cross product of lines is too uncertain to be a normal.
constexpr Real flat_angle_squared = 1e-16;
/// The same, below which nothing is left of it but rounding.
constexpr Real no_angle_squared = 1e-29;
/// The same, below which the closest points of edges are looked for among their ends as well.
constexpr Real doubtful_angle_squared = 1e-6;
/// Of the size of the features: below this distance the difference of the closest points does not tell the direction.
constexpr Real unclear_share = 1e-3;

/// Squares of lengths below which they lose digits.
constexpr Real least_square = 1e-250;
/// Shares of an edge or a triangle below which a point is on the border of it. It takes the doubt away from where
/// meshes like to meet, a vertex over a vertex or over a diagonal: there rounding would let it count twice or not at
/// all.
constexpr Real border_share = 1e-7;

/// Of an edge that leads from a vertex towards what the vertex is near: the vertex is not what comes first.
constexpr Real steep_sine = 0.5;

/// A point as seen from a line.
struct Foot {
  Real share = 0;            ///< of the way from a to b at the closest point of the line
  Vec3 away = Vec3::Zero();  ///< from there to the point
  Real squared_edge = 0;
};

Foot foot_on(const Vec3& a, const Vec3& b, const Vec3& x) {
  const Vec3 edge = b - a;
  const Vec3 from = x - a;
  const Real squared = edge.squaredNorm();
  if (!(squared > 0)) return {0, from, 0};
  const Real share = from.dot(edge) / squared;
  return {share, from - share * edge, squared};
}

/// The share that corner c has of x in the plane of a, b, c, where foot is that of x on the line through a and b, and
/// corner that of c.
Real share_of_corner(const Foot& foot, const Foot& corner, const Vec3& a, const Vec3& c) {
  const Real squared = corner.away.squaredNorm();
  const Real size = std::max(foot.squared_edge, (c - a).squaredNorm());
  return squared > no_angle_squared * size ? foot.away.dot(corner.away) / squared : 0;
}

Real share_of_corner(const Foot& foot, const Vec3& a, const Vec3& b, const Vec3& c) {
  return share_of_corner(foot, foot_on(a, b, c), a, c);
}

/// The closest point of a segment.
struct OnSegment {
  Real share = 0;
  Vec3 difference = Vec3::Zero();  ///< from it to the point
};

OnSegment clamped(const Foot& foot, const Vec3& a, const Vec3& b, const Vec3& x) {
  if (!(foot.share > 0)) return {0, x - a};
  if (!(foot.share < 1)) return {1, x - b};
  return {foot.share, foot.away};
}

OnSegment closest_on_segment(const Vec3& a, const Vec3& b, const Vec3& x) {
  return clamped(foot_on(a, b, x), a, b, x);
}

/// The corners of an edge, the smaller index first, so that all triangles see it in the same way.
struct SortedEdge {
  Vec3 a, b;
  bool is_turned;

  SortedEdge(const Positions& q, Index first, Index second)
      : a(row(q, std::min(first, second))), b(row(q, std::max(first, second))), is_turned(first > second) {}
  /// From the first corner that was given.
  Real turned(Real share) const { return is_turned ? 1 - share : share; }
  /// 0 at the first corner that was given, 1 at the second, else `between`.
  std::uint8_t place(Real share, std::uint8_t between) const {
    if (!(share > border_share)) return is_turned ? 1 : 0;
    if (!(share < 1 - border_share)) return is_turned ? 0 : 1;
    return between;
  }
};

/// A unit vector along x, or false.
bool is_direction(const Vec3& x, Vec3& direction) {
  const Real largest = x.cwiseAbs().maxCoeff();
  if (!(largest > 0)) return false;
  direction = (x / largest).normalized();
  return true;
}

Vec3 any_across(const Vec3& x) {
  Index least = 0;
  x.cwiseAbs().minCoeff(&least);
  Vec3 direction = Vec3::UnitZ();
  return is_direction(x.cross(Vec3::Unit(least)), direction) ? direction : Vec3::UnitZ();
}

/// Distance and normal from the difference of the closest points. Where it is unclear: `across`, what the features have
/// as a normal there if it is certain; `line` is one that the normal is across; `spare` for a distance of 0.
struct Directions {
  Vec3 across = Vec3::Zero();
  Vec3 line = Vec3::Zero();
  Vec3 spare = Vec3::Zero();
  Vec3 longest = Vec3::Zero();
};

bool is_clear(const Vec3& difference, Real squared_size, Gap& gap) {
  const Real squared = difference.squaredNorm();
  if (!(squared > unclear_share * unclear_share * squared_size && squared > least_square)) {
    gap.distance = difference.stableNorm();
    return false;
  }
  gap.distance = std::sqrt(squared);
  gap.normal = difference * (1 / gap.distance);
  return true;
}

void set_unclear_normal(const Vec3& difference, const Directions& has, Gap& gap) {
  if (is_direction(has.across, gap.normal)) {
    if (gap.normal.dot(difference) < 0) gap.normal = -gap.normal;
    return;
  }
  Vec3 line;
  Vec3 found;
  if (is_direction(difference, found)) {
    if (!is_direction(has.line, line) || is_direction(found - found.dot(line) * line, found)) {
      gap.normal = found;
      return;
    }
  }
  if (is_direction(has.spare, gap.normal)) return;
  gap.normal = any_across(has.longest);
}

const Vec3& longer(const Vec3& a, const Vec3& b) {
  return b.squaredNorm() > a.squaredNorm() ? b : a;
}

/// The cross product of two edges, zero where their directions are the same but for rounding.
Vec3 normal_of(const Vec3& a, const Vec3& b) {
  const Vec3 normal = a.cross(b);
  return normal.squaredNorm() > flat_angle_squared * a.squaredNorm() * b.squaredNorm() ? normal : Vec3::Zero();
}

/// A point as seen from the edges of a triangle.
struct SeenFromTriangle {
  Vec3 x;
  std::array<Vec3, 3> corners;
  std::array<Foot, 3> feet;
  std::array<Foot, 3> heights;   ///< of the corner opposite each edge
  std::array<Real, 3> shares{};  ///< of the corners, in the plane; but for their sum
  Real squared_size = 0;
  std::size_t longest = 0;  ///< edge

  SeenFromTriangle(const Positions& q, const Pair& pair) : x(row(q, pair.vertices[0])) {
    for (std::size_t i = 0; i < 3; ++i) corners[i] = row(q, pair.vertices[1 + i]);
    for (std::size_t e = 0; e < 3; ++e) {
      const SortedEdge sorted = edge(q, pair, e);
      const std::size_t opposite = (e + 2) % 3;
      feet[e] = foot_on(sorted.a, sorted.b, x);
      heights[e] = foot_on(sorted.a, sorted.b, corners[opposite]);
      shares[opposite] = share_of_corner(feet[e], heights[e], sorted.a, corners[opposite]);
      if (feet[e].squared_edge > squared_size) longest = e;
      squared_size = std::max(squared_size, feet[e].squared_edge);
    }
  }
  static SortedEdge edge(const Positions& q, const Pair& pair, std::size_t e) {
    return {q, pair.vertices[1 + e], pair.vertices[1 + (e + 1) % 3]};
  }
  /// Each corner has more than this share of x.
  bool is_inside(Real least) const { return shares[0] > least && shares[1] > least && shares[2] > least; }

  /// Sets the weights of the closest point; returns the difference from there to x. From the longest edge on, which is
  /// right within rounding for the thinnest triangle too.
  Vec3 over_interior(const Positions& q, const Pair& pair, Gap& gap) const {
    const Foot& foot = feet[longest];
    const Foot& height = heights[longest];
    const std::size_t next = (longest + 1) % 3;
    const std::size_t opposite = (longest + 2) % 3;
    const Real share = shares[opposite];
    const Real of_second = foot.share - share * height.share;
    const bool is_turned = edge(q, pair, longest).is_turned;
    gap.weights[1 + opposite] = -share;
    gap.weights[1 + (is_turned ? longest : next)] = -of_second;
    gap.weights[1 + (is_turned ? next : longest)] = share + of_second - 1;
    return foot.away - share * height.away;
  }
  /// The same, of the edges and corners alone.
  Vec3 over_border(const Positions& q, const Pair& pair, Gap& gap) const {
    Vec3 difference = Vec3::Zero();
    Real least = -1;
    for (std::size_t e = 0; e < 3; ++e) {
      const SortedEdge sorted = edge(q, pair, e);
      const OnSegment found = clamped(feet[e], sorted.a, sorted.b, x);
      const Real squared = found.difference.squaredNorm();
      if (least >= 0 && !(squared < least)) continue;
      least = squared;
      difference = found.difference;
      const std::size_t next = (e + 1) % 3;
      const Real share = sorted.turned(found.share);
      gap.weights = {1, 0, 0, 0};
      gap.weights[1 + e] = share - 1;
      gap.weights[1 + next] = -share;
      const std::uint8_t end = sorted.place(found.share, Gap::interior);
      gap.place = static_cast<std::uint8_t>(end == Gap::interior ? e : 3 + (end == 0 ? e : next));
    }
    return difference;
  }
};

Gap gap_of_triangle(const Positions& q, const Pair& pair) {
  const SeenFromTriangle seen(q, pair);
  Gap gap;
  gap.weights[0] = 1;
  const bool is_inside = seen.is_inside(border_share);
  Vec3 difference = Vec3::Zero();
  if (!is_inside) difference = seen.over_border(q, pair, gap);
  if (is_inside || seen.is_inside(0)) difference = seen.over_interior(q, pair, gap);
  gap.counts = is_inside || (pair.owned >> gap.place & 1) != 0;
  if (is_clear(difference, seen.squared_size, gap)) return gap;
  const auto& [a, b, c] = seen.corners;
  const std::array<Vec3, 3> edges{b - a, c - b, a - c};
  Directions directions;
  directions.spare = normal_of(edges[0], edges[1]);
  if (seen.is_inside(0)) directions.across = directions.spare;
  if (gap.place < 3) directions.line = edges[gap.place];
  directions.longest = longer(longer(edges[0], edges[1]), edges[2]);
  set_unclear_normal(difference, directions, gap);
  return gap;
}

/// Of two edges, one of whose ends is closest.
void set_gap_of_ends(const std::array<Vec3, 4>& x, Gap& gap, Vec3& difference, Vec3& line) {
  Real least = -1;
  for (std::size_t end = 0; end < 4; ++end) {
    const bool is_first = end < 2;
    const std::size_t other = is_first ? 2 : 0;
    const OnSegment found = closest_on_segment(x[other], x[other + 1], x[end]);
    const Real squared = found.difference.squaredNorm();
    if (least >= 0 && !(squared < least)) continue;
    least = squared;
    const Real sign = is_first ? 1 : -1;
    difference = sign * found.difference;
    line = found.share > 0 && found.share < 1 ? Vec3(x[other + 1] - x[other]) : Vec3(Vec3::Zero());
    gap.weights = {};
    gap.weights[end] = sign;
    gap.weights[other] = -sign * (1 - found.share);
    gap.weights[other + 1] = -sign * found.share;
  }
}

bool is_between(Real share, Real border) {
  return share > border && share < 1 - border;
}

/// Two edges, from the beginning of the first; and the closest points of their lines where these are certain.
struct SeenEdges {
  Vec3 first, second, between, normal;
  Real squared_first, squared_second, squared_normal;

  explicit SeenEdges(const std::array<Vec3, 4>& x)
      : first(x[1] - x[0]),
        second(x[3] - x[2]),
        between(x[2] - x[0]),
        normal(first.cross(second)),
        squared_first(first.squaredNorm()),
        squared_second(second.squaredNorm()),
        squared_normal(normal.squaredNorm()) {}
  bool are_parallel() const { return !(squared_normal > no_angle_squared * squared_first * squared_second); }
  /// Almost: an end may be nearer than the points that rounding leaves.
  bool are_doubtful() const { return !(squared_normal > doubtful_angle_squared * squared_first * squared_second); }
  Real on_first() const { return between.cross(second).dot(normal) / squared_normal; }
  Real closest_on_second(Real s) const { return (s * first - between).dot(second) / squared_second; }
  Real closest_on_first(Real t) const { return (t * second + between).dot(first) / squared_first; }
  Vec3 difference(Real s, Real t) const { return s * first - between - t * second; }
};

Gap gap_of_edges(const Positions& q, const Pair& pair) {
  std::array<Vec3, 4> x;
  for (std::size_t i = 0; i < 4; ++i) x[i] = row(q, pair.vertices[i]);
  const SeenEdges seen(x);
  Gap gap;
  Vec3 difference;
  bool is_inside = false;
  Directions directions;
  if (!seen.are_parallel()) {
    const Real line = seen.on_first();
    Real s = std::clamp(line, Real{0}, Real{1});
    Real t = seen.closest_on_second(s);
    is_inside = is_between(line, 0) && is_between(t, 0);
    gap.counts = is_between(line, border_share) && is_between(t, border_share);
    if (!is_between(t, 0)) {
      t = std::clamp(t, Real{0}, Real{1});
      s = std::clamp(seen.closest_on_first(t), Real{0}, Real{1});
    }
    gap.weights = {1 - s, s, t - 1, -t};
    difference = seen.difference(s, t);
    directions.line = is_between(s, 0) ? seen.first : is_between(t, 0) ? seen.second : Vec3(Vec3::Zero());
  }
  if (seen.are_doubtful()) {
    Gap of_ends;
    Vec3 of_ends_difference, line;
    set_gap_of_ends(x, of_ends, of_ends_difference, line);
    if (seen.are_parallel() || of_ends_difference.squaredNorm() < difference.squaredNorm()) {
      gap = of_ends;
      difference = of_ends_difference;
      directions.line = line;
      is_inside = false;
    }
  }
  const Real squared_size = std::max(seen.squared_first, seen.squared_second);
  if (is_clear(difference, squared_size, gap)) return gap;
  directions.spare = normal_of(seen.first, seen.second);
  directions.longest = longer(seen.first, seen.second);
  if (is_inside) directions.across = directions.spare;
  set_unclear_normal(difference, directions, gap);
  return gap;
}

Gap gap_of_loose_edge(const Positions& q, const Pair& pair) {
  const Vec3 x = row(q, pair.vertices[0]);
  const SortedEdge edge(q, pair.vertices[1], pair.vertices[2]);
  const OnSegment found = closest_on_segment(edge.a, edge.b, x);
  const Real share = edge.turned(found.share);
  Gap gap;
  gap.weights = {1, share - 1, -share, 0};
  gap.place = edge.place(found.share, Gap::interior);
  gap.counts = gap.place == Gap::interior || (pair.owned >> gap.place & 1) != 0;
  Directions directions;
  directions.longest = edge.b - edge.a;
  if (gap.place == Gap::interior) directions.line = directions.longest;
  if (!is_clear(found.difference, directions.longest.squaredNorm(), gap)) {
    set_unclear_normal(found.difference, directions, gap);
  }
  return gap;
}

/// Whether a triangle at an edge comes nearer to a point that is `away` from the edge, and across it.
bool is_triangle_nearer(const Positions& q, const Surface& surface, Index edge, const Vec3& away) {
  const auto& [first, second] = surface.edges[at(edge)];
  const SortedEdge sorted(q, first, second);
  const Foot foot{0, away, (sorted.b - sorted.a).squaredNorm()};
  return std::ranges::any_of(surface.opposite(edge), [&](Index c) {
    return share_of_corner(foot, sorted.a, sorted.b, row(q, c)) > border_share;
  });
}

}  // namespace

Gap measure(const Positions& q, const Pair& pair) {
  switch (pair.kind) {
    case PairKind::vertex_triangle:
      return gap_of_triangle(q, pair);
    case PairKind::edge_edge:
      return gap_of_edges(q, pair);
    case PairKind::vertex_edge:
      break;
  }
  return gap_of_loose_edge(q, pair);
}

bool is_nearest_there(const Positions& q, const Surface& surface, const Pair& pair, const Gap& gap) {
  if (gap.place == Gap::interior || pair.kind == PairKind::edge_edge) return true;
  const Vec3 x = row(q, pair.vertices[0]);
  const bool is_triangle = pair.kind == PairKind::vertex_triangle;
  if (is_triangle && gap.place < 3) {
    const Index e = gap.place;
    const SortedEdge edge(q, pair.vertices[at(1 + e)], pair.vertices[at(1 + (e + 1) % 3)]);
    const Vec3 away = foot_on(edge.a, edge.b, x).away;
    return !is_triangle_nearer(q, surface, surface.triangle_edges[at(pair.features[1])][at(e)], away);
  }
  const Index corner = pair.vertices[is_triangle ? gap.place - 2U : gap.place + 1U];
  return std::ranges::all_of(surface.neighbors(corner), [&](Index neighbor) {
    const SortedEdge edge(q, corner, neighbor);
    return edge.place(foot_on(edge.a, edge.b, x).share, Gap::interior) == 0;
  });
}

bool is_minimum_there(const Positions& q, const Surface& surface, const Pair& pair, const Gap& gap) {
  if (pair.kind != PairKind::edge_edge) {
    const Vec3 x = row(q, pair.vertices[0]);
    const auto goes_down = [&](Index neighbor) {
      const Vec3 edge = row(q, neighbor) - x;
      return edge.dot(gap.normal) < -steep_sine * edge.norm();
    };
    return is_nearest_there(q, surface, pair, gap) &&
           std::ranges::none_of(surface.neighbors(pair.vertices[0]), goes_down);
  }
  const Vec3 away = gap.distance * gap.normal;
  return gap.counts && !is_triangle_nearer(q, surface, pair.features[0], -away) &&
         !is_triangle_nearer(q, surface, pair.features[1], away);
}

}  // namespace pliant
