// Paths along the vertices of something else that moves.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "pliant/mesh/nearest_vertex.h"
#include "pliant/timeline/path.h"

namespace pliant {
namespace {

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

void check_followed(const MotionNumbers& numbers, Index vertex_count) {
  for (const MotionPoint& point : numbers.points) {
    if (point.vertex >= 0 && point.vertex < vertex_count) continue;
    fail_input(
        fmt::format("a point follows vertex {}, but there are {}; begin the motion anew", point.vertex, vertex_count));
  }
}

class BodyPath final : public Path {
 public:
  BodyPath(BodyId body, std::vector<Index> vertices, Attach attach)
      : body_(body), vertices_(std::move(vertices)), attach_(attach) {}

  void begin(const Simulation& simulation, std::optional<GroupId> group, MotionNumbers& numbers) const override {
    const Body& followed = simulation.body(body_);
    if (group && simulation.groups().at(*group).body == body_) {
      fail_input("a group cannot follow the body that it holds; name another body");
    }
    const Positions x = simulation.state().positions.middleRows(followed.first_vertex, followed.mesh.vertex_count());
    attach_points(x, vertices_, attach_, numbers);
  }

  void check(const Simulation& simulation, const MotionNumbers& numbers) const override {
    check_followed(numbers, simulation.body(body_).mesh.vertex_count());
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

class AnimationPath final : public Path {
 public:
  AnimationPath(std::shared_ptr<PointAnimation> animation, std::vector<Index> points, Attach attach)
      : animation_(std::move(animation)), points_(std::move(points)), attach_(attach) {}

  Real duration() const override { return animation_->duration(); }

  void begin(const Simulation&, std::optional<GroupId>, MotionNumbers& numbers) const override {
    Positions first;
    animation_->sample(0, first);
    attach_points(first, points_, attach_, numbers);
  }

  void check(const Simulation&, const MotionNumbers& numbers) const override {
    check_followed(numbers, animation_->point_count());
  }

  void go_to(const Simulation&, const MotionNumbers&, Real elapsed) override {
    animation_->sample(elapsed, positions_);
  }

  Vec3 at(const MotionPoint& point) const override { return row(positions_, point.vertex) + point.from; }

 private:
  std::shared_ptr<PointAnimation> animation_;
  std::vector<Index> points_;
  Attach attach_;
  Positions positions_;  // scratch
};

class RepeatedAnimation final : public PointAnimation {
 public:
  explicit RepeatedAnimation(std::shared_ptr<PointAnimation> animation) : animation_(std::move(animation)) {}

  Index point_count() const override { return animation_->point_count(); }
  Real duration() const override { return Path::endless; }
  void sample(Real elapsed, Positions& positions) override {
    animation_->sample(std::fmod(elapsed, animation_->duration()), positions);
  }

 private:
  std::shared_ptr<PointAnimation> animation_;
};

}  // namespace

std::shared_ptr<PointAnimation> repeated(std::shared_ptr<PointAnimation> animation) {
  if (!(animation->duration() > 0)) fail_input("an animation of one frame cannot be repeated; give two frames or more");
  return std::make_shared<RepeatedAnimation>(std::move(animation));
}

std::shared_ptr<Path> follow_body(BodyId body, std::vector<Index> vertices, Attach attach) {
  return std::make_shared<BodyPath>(body, std::move(vertices), attach);
}

std::shared_ptr<Path> follow_animation(std::shared_ptr<PointAnimation> animation, std::vector<Index> points,
                                       Attach attach) {
  return std::make_shared<AnimationPath>(std::move(animation), std::move(points), attach);
}

}  // namespace pliant
