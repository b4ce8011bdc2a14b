#include "pliant/timeline/path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace pliant {
namespace {

void check_points(const Points& points) {
  for (const Vec3& point : points.list()) {
    if (!point.allFinite()) fail_input("a point is not finite; give three finite numbers");
  }
}

/// The share of the way after a share of the time, both 0 to 1.
Real eased(Real share, Ease ease) {
  return ease == Ease::linear ? share : share * share * (3 - 2 * share);
}

class StraightPath final : public Path {
 public:
  StraightPath(MoveKind kind, Points to, Real duration, Ease ease)
      : kind_(kind), to_(std::move(to)), duration_(duration), ease_(ease) {}

  Real duration() const override { return duration_; }

  void begin(const Simulation&, std::optional<GroupId>, MotionNumbers& numbers) const override {
    if (!to_.each() || to_.list().size() == numbers.points.size()) return;
    fail_input(fmt::format("{} points for {} constraints; give one for all, or one each", to_.list().size(),
                           numbers.points.size()));
  }

  void check(const Simulation&, const MotionNumbers& numbers) const override {
    if (!to_.each()) return;
    for (const MotionPoint& point : numbers.points) {
      if (point.place >= 0 && static_cast<std::size_t>(point.place) < to_.list().size()) continue;
      fail_input(fmt::format("point {} of a path of {} points; begin the motion anew", point.place, to_.list().size()));
    }
  }

  void go_to(const Simulation&, const MotionNumbers&, Real elapsed) override {
    share_ = elapsed >= duration_ ? 1 : eased(elapsed / duration_, ease_);
  }

  Vec3 at(const MotionPoint& point) const override {
    const Vec3& given = to_[point.place];
    const Vec3 to = kind_ == MoveKind::target ? given : Vec3(point.from + given);
    return share_ == 1 ? to : Vec3(point.from + share_ * (to - point.from));
  }

 private:
  MoveKind kind_;
  Points to_;
  Real duration_;
  Ease ease_;
  Real share_ = 0;  // scratch
};

using Displacement = Eigen::Matrix<Real, 6, 1>;  // translation and rotation vector

struct Key {
  Real time;
  Displacement pose;
  Displacement velocity = Displacement::Zero();
};

/// A rigid motion of all points about a center.
class RigidPath : public Path {
 public:
  explicit RigidPath(std::optional<Vec3> center) : center_(center) {}

  void begin(const Simulation&, std::optional<GroupId>, MotionNumbers& numbers) const override {
    if (center_) {
      numbers.center = *center_;
      return;
    }
    Vec3 sum = Vec3::Zero();
    for (const MotionPoint& point : numbers.points) sum += point.from;
    numbers.center = sum / static_cast<Real>(numbers.points.size());
  }

  void go_to(const Simulation&, const MotionNumbers& numbers, Real elapsed) override {
    const Displacement pose = pose_at(elapsed);
    const Vec3 turn = pose.tail<3>();
    const Real angle = turn.norm();
    turn_ = angle > 0 ? Eigen::AngleAxis<Real>(angle, turn / angle) : Eigen::AngleAxis<Real>::Identity();
    rotation_ = turn_.toRotationMatrix();
    center_now_ = numbers.center;
    translation_ = pose.head<3>();
  }

  Vec3 at(const MotionPoint& point) const override {
    return center_now_ + translation_ + rotation_ * (point.from - center_now_);
  }

  Quaternion rotation() const override { return Quaternion(turn_); }

 private:
  virtual Displacement pose_at(Real elapsed) const = 0;

  std::optional<Vec3> center_;
  // Scratch.
  Eigen::AngleAxis<Real> turn_ = Eigen::AngleAxis<Real>::Identity();
  Mat3 rotation_ = Mat3::Identity();
  Vec3 translation_ = Vec3::Zero();
  Vec3 center_now_ = Vec3::Zero();
};

class KeyframePath final : public RigidPath {
 public:
  KeyframePath(std::vector<Key> keys, std::optional<Vec3> center, Ease ease)
      : RigidPath(center), keys_(std::move(keys)), ease_(ease) {
    // Each key's slope is the mean of those beside it, weighted so that a parabola would keep its own; 0 at the ends.
    for (std::size_t i = 1; i + 1 < keys_.size(); ++i) {
      const Real before = keys_[i].time - keys_[i - 1].time;
      const Real after = keys_[i + 1].time - keys_[i].time;
      const Displacement slope_before = (keys_[i].pose - keys_[i - 1].pose) / before;
      const Displacement slope_after = (keys_[i + 1].pose - keys_[i].pose) / after;
      keys_[i].velocity = (after * slope_before + before * slope_after) / (before + after);
    }
  }

  Real duration() const override { return keys_.back().time; }

 private:
  Displacement pose_at(Real elapsed) const override {
    const auto next = std::ranges::find_if(keys_, [&](const Key& key) { return key.time > elapsed; });
    if (next == keys_.end()) return keys_.back().pose;
    if (next == keys_.begin()) return keys_.front().pose;
    const Key& from = *(next - 1);
    const Real length = next->time - from.time;
    const Real u = (elapsed - from.time) / length;
    if (ease_ == Ease::linear) return from.pose + u * (next->pose - from.pose);
    const Real w = 1 - u;  // cubic Hermite polynomials
    return w * w * (1 + 2 * u) * from.pose + u * u * (1 + 2 * w) * next->pose +
           u * w * length * (w * from.velocity - u * next->velocity);
  }

  std::vector<Key> keys_;
  Ease ease_;
};

class SteadyPath final : public RigidPath {
 public:
  SteadyPath(const Displacement& speed, std::optional<Vec3> center) : RigidPath(center), speed_(speed) {}

 private:
  Displacement pose_at(Real elapsed) const override { return elapsed * speed_; }

  Displacement speed_;  // velocity and angular velocity
};

}  // namespace

void Path::begin(const Simulation&, std::optional<GroupId>, MotionNumbers&) const {}

std::shared_ptr<Path> straight_path(MoveKind kind, Points to, Real duration, Ease ease) {
  if (!(duration >= 0) || !std::isfinite(duration)) {
    fail_input(fmt::format("the duration {} s is out of range; give a finite number, 0 or more", duration));
  }
  if (to.empty()) fail_input("no point to move to; give one for all, or one each");
  check_points(to);
  return std::make_shared<StraightPath>(kind, std::move(to), duration, ease);
}

Vec3 Rotation::vector() const {
  const Real length = axis.stableNorm();
  if (!(length > 0) || !std::isfinite(length)) fail_input("an axis of length 0 has no direction; give another");
  if (!std::isfinite(degrees)) fail_input("the degrees are not finite; give a finite number");
  return axis / length * (degrees * std::numbers::pi / 180);
}

std::shared_ptr<Path> rigid_path(std::vector<Keyframe> keys, std::optional<Vec3> center, Ease ease) {
  if (keys.empty()) fail_input("keyframes: the list is empty; give one or more");
  if (center) check_points(Points(*center));
  std::vector<Key> poses;
  if (keys.front().time > 0) poses.push_back({0, Displacement::Zero()});
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Real time = keys[i].time;
    if (!(time >= 0) || !std::isfinite(time) || (i > 0 && time <= keys[i - 1].time)) {
      fail_input(fmt::format(
          "keyframes[{}]: the time {} s does not come after the one before; let times rise from 0 up", i, time));
    }
    check_points(Points(keys[i].translate));
    const Vec3 turn = keys[i].rotate.vector();
    Displacement pose;
    pose << keys[i].translate, turn;
    poses.push_back({time, pose});
  }
  return std::make_shared<KeyframePath>(std::move(poses), center, ease);
}

std::shared_ptr<Path> steady_path(const Vec3& velocity, const Vec3& angular_velocity, std::optional<Vec3> center) {
  for (const Vec3& each : {velocity, angular_velocity, center.value_or(Vec3::Zero())}) check_points(Points(each));
  Displacement speed;
  speed << velocity, angular_velocity;
  return std::make_shared<SteadyPath>(speed, center);
}

}  // namespace pliant
