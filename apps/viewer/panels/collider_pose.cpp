// Where the collider is that is selected, in the panel.
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include <imgui.h>

#include "viewer/panels/panel_style.h"
#include "viewer/panels/parameter_panel.h"

namespace pliant_viewer {
namespace {

constexpr Real degree = std::numbers::pi / 180;

/// Posts a call for the collider of that name.
void post_to(const std::string& name, LiveScene& live, LiveScene::Kind kind,
             const std::function<void(Session&, pliant::ColliderId)>& act) {
  live.post(
      [name, act](CommandContext& context) {
        if (const auto id = context.session.simulation().find_collider(name)) act(context.session, *id);
      },
      kind);
}

void drop(const std::string& name, LiveScene& live) {
  post_to(name, live, LiveScene::Kind::changes,
          [](Session& session, pliant::ColliderId dropped) { session.drop_collider(dropped); });
}

}  // namespace

void ParameterPanel::end_lost_drag(LiveScene& live) {
  if (!moved_ || ImGui::IsMouseDown(ImGuiMouseButton_Left) || ImGui::IsAnyItemActive()) return;
  drop(std::exchange(moved_, std::nullopt)->collider, live);
}

/// Where it will come to rest, which can be changed.
void ParameterPanel::draw_pose(const MovableCollider& collider, LiveScene& live) {
  const auto draw = [&](const char* label, const char* unit, const char* help, const char* id, pliant::Vec3 value,
                        float speed,
                        const std::function<void(Session&, pliant::ColliderId, const pliant::Vec3&)>& act) {
    row_label(label_with_unit(label, unit), help);
    // While the hand is on it the simulation may be some steps behind.
    const auto is_moved = [&] { return moved_ && moved_->collider == collider.name && moved_->id == id; };
    if (is_moved()) value = moved_->value;
    const bool has_changed = vector_fields(id, value.data(), speed, unit);
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    places_[collider.name + id] = {low.x, low.y, high.x, high.y};
    if (has_changed && value.allFinite()) {
      moved_ = {collider.name, id, value};
      post_to(collider.name, live, LiveScene::Kind::steers,
              [act, value](Session& session, pliant::ColliderId to) { act(session, to, value); });
    }
    if (!ImGui::IsItemDeactivated() || !is_moved()) return;
    moved_.reset();
    drop(collider.name, live);
  };
  draw("place", "m", "where it will come to rest; a plane goes along its normal", "##place", collider.pose.position,
       0.01F, [](Session& session, pliant::ColliderId id, const pliant::Vec3& to) {
         session.move_collider(id, to.cast<float>());
       });
  const Eigen::AngleAxis<Real> turn(collider.pose.rotation);
  draw("turned", "°", "axis times angle, about its place", "##turned", turn.angle() / degree * turn.axis(), 1,
       [](Session& session, pliant::ColliderId id, const pliant::Vec3& to) { session.turn_collider(id, to * degree); });
}

}  // namespace pliant_viewer
