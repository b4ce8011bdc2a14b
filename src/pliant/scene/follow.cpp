// Paths along the vertices of something else that moves.
#include <algorithm>

#include <fmt/format.h>

#include "pliant/scene/path.h"

namespace pliant {
namespace {

/// Finds nearest vertices by a tree of halves, each cut across the longest side of its box.
class NearestVertex {
 public:
  explicit NearestVertex(const Positions& x) : x_(x), cuts_(static_cast<std::size_t>(x.rows())) {
    for (Index i = 0; i < x.rows(); ++i) order_.push_back(i);
    build(order_);
  }

  /// Of several at the same distance the first.
  Index operator()(const Vec3& place) const {
    Best best;
    search(order_, place, best);
    return best.vertex;
  }

 private:
  struct Best {
    Real squared = std::numeric_limits<Real>::infinity();
    Index vertex = 0;
  };

  std::size_t place_of(const Index& entry) const { return static_cast<std::size_t>(&entry - order_.data()); }

  /// Sorts a part into those below its middle, the middle, where the axis is noted, and those above.
  void build(std::span<Index> part) {
    if (part.size() < 2) return;
    Vec3 min = row(x_, part[0]);
    Vec3 max = min;
    for (const Index i : part) {
      min = min.cwiseMin(row(x_, i));
      max = max.cwiseMax(row(x_, i));
    }
    Index axis = 0;
    (max - min).maxCoeff(&axis);
    const std::size_t middle = part.size() / 2;
    std::ranges::nth_element(part, part.begin() + static_cast<std::ptrdiff_t>(middle), {},
                             [&](Index i) { return x_(i, axis); });
    cuts_[place_of(part[middle])] = axis;
    build(part.first(middle));
    build(part.subspan(middle + 1));
  }

  void search(std::span<const Index> part, const Vec3& place, Best& best) const {
    if (part.empty()) return;
    const std::size_t middle = part.size() / 2;
    const Index vertex = part[middle];
    const Real squared = (row(x_, vertex) - place).squaredNorm();
    if (squared < best.squared || (squared == best.squared && vertex < best.vertex)) best = {squared, vertex};
    const Index axis = cuts_[place_of(part[middle])];
    const Real above = place[axis] - x_(vertex, axis);
    const std::span<const Index> low = part.first(middle);
    const std::span<const Index> high = part.subspan(middle + 1);
    search(above < 0 ? low : high, place, best);
    if (above * above <= best.squared) search(above < 0 ? high : low, place, best);
  }

  const Positions& x_;
  std::vector<Index> order_;
  std::vector<Index> cuts_;  // the axis of the cut at each place of order_
};

/// Gives each point its vertex, and the distance that it keeps. `x`: where the followed vertices are now.
void attach_points(const Positions& x, const std::vector<Index>& vertices, Attach attach, MotionNumbers& numbers) {
  const std::size_t count = numbers.points.size();
  if (vertices.size() > 1 && vertices.size() != count) {
    fail_input(
        fmt::format("{} vertices for {} constraints that follow them; give one each, one for all, or none: then "
                    "each takes the nearest",
                    vertices.size(), count));
  }
  for (const Index vertex : vertices) {
    if (vertex >= 0 && vertex < x.rows()) continue;
    fail_input(fmt::format("vertex {} is out of range; what is followed has vertices 0 to {}", vertex, x.rows() - 1));
  }
  std::optional<NearestVertex> nearest;
  if (vertices.empty()) nearest.emplace(x);
  for (MotionPoint& point : numbers.points) {
    const auto place = static_cast<std::size_t>(point.place);
    point.vertex = nearest ? (*nearest)(point.from) : vertices[vertices.size() == 1 ? 0 : place];
    point.from = attach == Attach::exact ? Vec3(Vec3::Zero()) : Vec3(point.from - row(x, point.vertex));
  }
}

class BodyPath final : public Path {
 public:
  BodyPath(BodyId body, std::vector<Index> vertices, Attach attach)
      : body_(body), vertices_(std::move(vertices)), attach_(attach) {}

  void begin(const Simulation& simulation, GroupId group, MotionNumbers& numbers) const override {
    const Body& followed = simulation.body(body_);
    if (simulation.groups().at(group).body == body_) {
      fail_input("a group cannot follow the body that it holds; name another body");
    }
    const Positions x = simulation.state().positions.middleRows(followed.first_vertex, followed.mesh.vertex_count());
    attach_points(x, vertices_, attach_, numbers);
  }

  void go_to(const Simulation& simulation, const MotionNumbers&, Real) override {
    positions_ = &simulation.state().positions;
    first_vertex_ = simulation.body(body_).first_vertex;
  }

  Vec3 at(const MotionPoint& point) const override {
    return row(*positions_, first_vertex_ + point.vertex) + point.from;
  }

 private:
  BodyId body_;
  std::vector<Index> vertices_;
  Attach attach_;
  // Scratch.
  const Positions* positions_ = nullptr;
  Index first_vertex_ = 0;
};

class CachePath final : public Path {
 public:
  CachePath(PointCache cache, std::vector<Index> vertices, Attach attach)
      : cache_(std::move(cache)), vertices_(std::move(vertices)), attach_(attach) {}

  Real duration() const override { return cache_.time(cache_.frame_count() - 1) - cache_.time(0); }

  void begin(const Simulation&, GroupId, MotionNumbers& numbers) const override {
    Positions first;
    cache_.frame(0, first);
    attach_points(first, vertices_, attach_, numbers);
  }

  void go_to(const Simulation&, const MotionNumbers&, Real elapsed) override {
    cache_.sample(cache_.time(0) + elapsed, positions_);
  }

  Vec3 at(const MotionPoint& point) const override { return row(positions_, point.vertex) + point.from; }

 private:
  PointCache cache_;
  std::vector<Index> vertices_;
  Attach attach_;
  Positions positions_;  // scratch
};

}  // namespace

std::shared_ptr<Path> follow_body(BodyId body, std::vector<Index> vertices, Attach attach) {
  return std::make_shared<BodyPath>(body, std::move(vertices), attach);
}

std::shared_ptr<Path> follow_cache(PointCache cache, std::vector<Index> vertices, Attach attach) {
  return std::make_shared<CachePath>(std::move(cache), std::move(vertices), attach);
}

}  // namespace pliant
