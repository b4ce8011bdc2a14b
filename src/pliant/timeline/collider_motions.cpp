#include "pliant/timeline/collider_motions.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace pliant {

void ColliderMotions::start(Simulation& simulation, ColliderId id, std::shared_ptr<Path> path, Index event,
                            Index order) {
  const Pose from = simulation.target(id).value_or(simulation.pose(id));
  Motion motion{id, std::move(path), {event, order, {}, from.rotation}};
  motion.state.numbers.begin = simulation.state().time;
  motion.state.numbers.points.push_back({0, 0, from.position});
  motion.path->begin(simulation, std::nullopt, motion.state.numbers);
  if (left_alone_.contains(id)) return;
  leave(id);
  if (motion.path->duration() > 0) {
    motions_.push_back(std::move(motion));
  } else {
    simulation.set_target(id, pose(simulation, motion, 0));
  }
}

void ColliderMotions::leave(ColliderId id) {
  std::erase_if(motions_, [id](const Motion& motion) { return motion.collider == id; });
}

void ColliderMotions::stop(const Simulation& simulation, ColliderId id) {
  simulation.collider(id);  // refuses one that there is not
  leave(id);
}

void ColliderMotions::leave_alone(const Simulation& simulation, ColliderId id) {
  stop(simulation, id);
  left_alone_.insert(id);
}

Pose ColliderMotions::pose(const Simulation& simulation, const Motion& motion, Real elapsed) {
  const MotionNumbers& numbers = motion.state.numbers;
  motion.path->go_to(simulation, numbers, elapsed);
  const Vec3 position = motion.path->at(numbers.points.front());
  return {position, (motion.path->rotation() * motion.state.rotation).normalized()};
}

void ColliderMotions::prepare(const Simulation& simulation) {
  std::erase_if(motions_, [&](const Motion& motion) { return !simulation.colliders().contains(motion.collider); });
  for (Motion& motion : motions_) motion.before = simulation.target(motion.collider);
}

void ColliderMotions::go_on(Simulation& simulation) {
  const Real end_of_step = simulation.state().time + simulation.settings().time_step;
  for (Motion& motion : motions_) {
    const Real elapsed = end_of_step - motion.state.numbers.begin;
    motion.has_arrived = is_past(elapsed, motion.path->duration());
    const Real place = motion.has_arrived ? motion.path->duration() : elapsed;
    simulation.set_target(motion.collider, pose(simulation, motion, place));
  }
}

void ColliderMotions::go_back(Simulation& simulation) const {
  for (const Motion& motion : motions_) {
    if (motion.before) {
      simulation.set_target(motion.collider, *motion.before);
    } else {
      simulation.clear_target(motion.collider);
    }
  }
}

void ColliderMotions::end_what_arrived() {
  std::erase_if(motions_, [](const Motion& motion) { return motion.has_arrived; });
}

std::vector<ColliderMotionNumbers> ColliderMotions::numbers() const {
  std::vector<ColliderMotionNumbers> numbers;
  for (const Motion& motion : motions_) numbers.push_back(motion.state);
  return numbers;
}

void ColliderMotions::restore(const Simulation& simulation, const std::vector<ColliderMotionNumbers>& numbers) {
  std::vector<Motion> motions;
  for (const ColliderMotionNumbers& saved : numbers) {
    const auto found = std::ranges::find_if(motions_, [&](const Motion& motion) {
      return motion.state.event == saved.event && motion.state.order == saved.order;
    });
    if (found == motions_.end()) {
      fail_input(fmt::format("motion {} of event {} moves no collider; begin those outside of events first",
                             saved.order, saved.event));
    }
    const bool is_sound = saved.numbers.points.size() == 1 && std::abs(saved.rotation.norm() - 1) < 1e-6;
    if (!is_sound) {
      fail_input(
          fmt::format("motion {} of event {}: a collider begins with one position and a rotation of length 1; "
                      "begin the motion anew",
                      saved.order, saved.event));
    }
    found->path->check(simulation, saved.numbers);
    motions.push_back(*found);
    motions.back().state = saved;
  }
  motions_ = std::move(motions);
}

}  // namespace pliant
