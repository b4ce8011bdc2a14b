#include "viewer/session_log.h"

#include "pliant_io/files/crc32.h"

namespace pliant_viewer {
namespace {

/// Whether the second one makes the first one, just before it, as if it had not been.
bool replaces(const Action& first, const Action& second) {
  if (std::holds_alternative<action::PullTo>(second)) return std::holds_alternative<action::PullTo>(first);
  if (std::holds_alternative<action::MoveHeld>(second)) return std::holds_alternative<action::MoveHeld>(first);
  if (const auto* pin = std::get_if<action::MovePin>(&second)) {
    const auto* before = std::get_if<action::MovePin>(&first);
    return before != nullptr && before->vertex == pin->vertex;
  }
  if (const auto* collider = std::get_if<action::MoveCollider>(&second)) {
    const auto* before = std::get_if<action::MoveCollider>(&first);
    return before != nullptr && before->collider == collider->collider;
  }
  if (const auto* collider = std::get_if<action::TurnCollider>(&second)) {
    const auto* before = std::get_if<action::TurnCollider>(&first);
    return before != nullptr && before->collider == collider->collider;
  }
  return false;
}

std::uint32_t checksum(const pliant::Positions& rows) {
  return pliant::crc32(
      {reinterpret_cast<const char*>(rows.data()), static_cast<std::size_t>(rows.size()) * sizeof(Real)});
}

}  // namespace

std::uint32_t state_checksum(const pliant::Simulation& simulation) {
  return checksum(simulation.state().positions) ^ (checksum(simulation.state().velocities) * 31);
}

void SessionLog::clear() {
  actions_.clear();
  checksums_.clear();
  steps_ = 0;
  forgets_this_ = depth_ > 0;
}

void SessionLog::took_step(const pliant::Simulation& simulation) {
  ++steps_;
  if (steps_ % checksum_period == 0) checksums_.push_back({steps_, state_checksum(simulation)});
}

void SessionLog::make_room() {
  if (actions_.size() == actions_.capacity()) actions_.reserve(2 * actions_.size() + 16);
}

void SessionLog::add(Action action) {
  // A hand that holds something moves many times between two steps, and for hours while time stands still.
  if (!actions_.empty() && actions_.back().step == steps_ && replaces(actions_.back().action, action)) {
    actions_.pop_back();
  }
  actions_.push_back({steps_, std::move(action)});
}

}  // namespace pliant_viewer
