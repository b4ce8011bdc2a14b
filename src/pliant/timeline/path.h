#pragma once
// Where moved targets are as time goes on. A motion of the timeline follows one path.
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "pliant/simulation/simulation.h"

namespace pliant {

/// The pace from one place to the next: at constant speed, or beginning and ending at rest.
enum class Ease { linear, smooth };
constexpr std::array<std::string_view, 2> choice_names(Ease) {
  return {"linear", "smooth"};
}

/// One point of a motion; plain numbers, which a checkpoint holds.
struct MotionPoint {
  Index number = 0;          ///< of the target, see Group::points
  Index place = 0;           ///< among the points that the motion began with
  Vec3 from = Vec3::Zero();  ///< where the target was when the motion began, or how far from what it follows [m]
  Index vertex = -1;         ///< that it follows
};

/// What a motion keeps of its begin.
struct MotionNumbers {
  Real begin = 0;              ///< tₙ [s]
  Vec3 center = Vec3::Zero();  ///< of its turning [m]
  std::vector<MotionPoint> points;
};

/// Whether a path of that duration is at its end: rounding of the time costs no further step.
inline bool is_past(Real elapsed, Real duration) {
  return elapsed >= duration * (1 - 1e-9);
}

/// A path has no state of its own but scratch: all that depends on when and where it began is in the MotionNumbers.
class Path {
 public:
  static constexpr Real endless = std::numeric_limits<Real>::infinity();

  virtual ~Path() = default;

  /// Refuses numbers of another path. Throws Error(input).
  virtual void check(const Simulation&, const MotionNumbers&) const {}

  /// Of the whole path [s]; 0: a jump.
  virtual Real duration() const { return endless; }
  /// Called once, when a motion begins; `from` of each point is then where its target is. No group: the one point is
  /// the position of a collider. Throws Error(input) when the path does not fit.
  virtual void begin(const Simulation& simulation, std::optional<GroupId> group, MotionNumbers& numbers) const;
  /// Called before at(): the time since the begin, at most duration(), that is asked for next.
  virtual void go_to(const Simulation& simulation, const MotionNumbers& numbers, Real elapsed) = 0;
  /// Where a point is then.
  virtual Vec3 at(const MotionPoint& point) const = 0;
  /// How a collider is then turned, from how it was when the motion began.
  virtual Quaternion rotation() const { return Quaternion::Identity(); }
};

/// What the points of a straight path mean: where to, or how far from where it begins.
enum class MoveKind { target, offset };

/// Straight to a point, or to one for each target moved. Throws Error(input), as those below do, on numbers that are
/// not finite, and on a duration below 0.
std::shared_ptr<Path> straight_path(MoveKind kind, Points to, Real duration = 0, Ease ease = Ease::linear);

/// A turn about an axis, counterclockwise seen against it.
struct Rotation {
  Vec3 axis{0, 0, 1};  ///< of any length but zero
  Real degrees = 0;    ///< may be more than a full turn

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"axis", "", "of any length but zero"}, self.axis);
    field(OptionInfo{"degrees", "", "counterclockwise, seen against the axis; more than 360 turn more than once",
                     Range{-1e9, 1e9}},
          self.degrees);
  }

  /// Axis times angle [rad]. Throws Error(input) on an axis of length zero.
  Vec3 vector() const;
};

/// Where a rigid motion has come at a time.
struct Keyframe {
  Real time = 0;                  ///< since the motion began [s]
  Vec3 translate = Vec3::Zero();  ///< from where it began [m]
  Rotation rotate{};              ///< from how it was when it began, about the center

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"time", "s", "since the move began; rising from key to key", not_negative}, self.time);
    field(OptionInfo{"translate", "m", "how far the points are then from where they began"}, self.translate);
    field(OptionInfo{"rotate", "", "how they are turned then about the center: `{\"axis\", \"degrees\"}`"},
          self.rotate);
  }
};

/// All points together, as one rigid body: x(t) = c + T(t) + R(t) (x₀ − c). T and the rotation vector (axis times
/// angle) of R are interpolated between the keys, linearly or by a cubic spline with continuous velocity that begins
/// and ends at rest; so turns about one axis go along circles, over any angle. Before a first key later than 0 the
/// path begins where the points are. Without a center it is the mean of the points as they begin.
std::shared_ptr<Path> rigid_path(std::vector<Keyframe> keys, std::optional<Vec3> center = {}, Ease ease = Ease::linear);

/// All points together at constant velocities, without an end: x(t) = c + t v + R(t ω) (x₀ − c), with v [m/s] and ω
/// [rad/s]. Without a center it is the mean of the points as they begin.
std::shared_ptr<Path> steady_path(const Vec3& velocity, const Vec3& angular_velocity = Vec3::Zero(),
                                  std::optional<Vec3> center = {});

/// How a target follows a vertex: in the distance in which it begins, or exactly where the vertex is.
enum class Attach { offset, exact };
constexpr std::array<std::string_view, 2> choice_names(Attach) {
  return {"offset", "exact"};
}

/// Follows vertices of a body: one for each target or one for all, with the indices of the body; when there are none,
/// each target takes the vertex that is nearest to it when the motion begins. A target is where its vertex was at the
/// start of the step, so it lags by one step.
std::shared_ptr<Path> follow_body(BodyId body, std::vector<Index> vertices = {}, Attach attach = Attach::offset);

/// Points that move by themselves: a recorded animation, a point cache.
class PointAnimation {
 public:
  virtual ~PointAnimation() = default;
  virtual Index point_count() const = 0;
  /// From its first to its last frame [s].
  virtual Real duration() const = 0;
  /// Where the points are at a time from 0, the first frame, to duration().
  virtual void sample(Real elapsed, Positions& positions) = 0;
};

/// The animation again and again, without an end: its last frame is its first one.
std::shared_ptr<PointAnimation> repeated(std::shared_ptr<PointAnimation> animation);

/// Follows the points of an animation, whose first frame is at the begin of the motion. A target is where its point is
/// at the end of the step, and stays where it is in the last frame. pliant_io/mesh/follow_cache.h reads animations from
/// files.
std::shared_ptr<Path> follow_animation(std::shared_ptr<PointAnimation> animation, std::vector<Index> points = {},
                                       Attach attach = Attach::offset);

}  // namespace pliant
