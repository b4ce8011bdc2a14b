#include "viewer/pin_gizmo.h"

#include <algorithm>

namespace pliant_viewer {
namespace {

using View = MouseInteraction::View;

}  // namespace

void PinGizmo::follow(const std::vector<std::uint32_t>& selected, const Snapshot& snapshot) {
  if (!is_up_to_date(snapshot)) return;
  pins_.clear();
  targets_.clear();
  Vec3f sum = Vec3f::Zero();
  for (const PinnedVertex& pin : snapshot.pinned) {
    if (!std::ranges::binary_search(selected, pin.vertex)) continue;
    pins_.push_back(static_cast<Index>(pin.vertex));
    targets_.push_back(pin.target);
    sum += pin.target;
  }
  if (pins_.empty()) return hide();
  Place place{.middle = sum / static_cast<float>(pins_.size())};
  // A single pin is dragged, and let go, as it is.
  if (pins_.size() == 1) place.left_out = {Part::plane, Part::turn_x, Part::turn_y, Part::turn_z};
  stand_at(place);
}

void PinGizmo::look_again(const View& view) {
  follow({pins_.begin(), pins_.end()}, *view.snapshot);
}

void PinGizmo::go_on_from(const RigidMotion& motion) {
  for (Vec3f& target : targets_) target = motion(target.cast<double>()).cast<float>();
}

void PinGizmo::take(const View& view) {
  post(view, LiveScene::Kind::changes, [pins = pins_](Session& session) { session.hold_pins(pins); });
}

std::uint64_t PinGizmo::move(const View& view) {
  return post(view, LiveScene::Kind::steers, [motion = motion()](Session& session) { session.move_held(motion); });
}

std::uint64_t PinGizmo::let_go(const View& view) {
  return post(view, LiveScene::Kind::changes, [](Session& session) { session.drop_held(); });
}

void PinGizmo::draw_targets(const View& view, ImDrawList& list) const {
  constexpr std::size_t most = 5000;  // more would slow the window down
  if (pins_.size() > most) return;
  const std::vector<Vec3f>& positions = view.snapshot->frame.content.positions;
  for (std::size_t i = 0; i < pins_.size(); ++i) {
    const Vec3f target = motion()(targets_[i].cast<double>()).cast<float>();
    draw_dot(view, positions[static_cast<std::size_t>(pins_[i])], target, list);
  }
}

}  // namespace pliant_viewer
