#include "viewer/wind_handle.h"

#include <algorithm>
#include <cmath>

#include "pliant/forces/wind.h"
#include "viewer/drawing.h"

namespace pliant_viewer {
namespace {

using View = MouseInteraction::View;

/// The velocity of the first wind that blows, which is the one that the arrow shows.
const Slider* find_wind(const Snapshot& snapshot) {
  const auto is_wind = [](const Slider& slider) {
    const pliant::Parameter& parameter = slider.parameter;
    return parameter.type == pliant::Wind::info.name && parameter.handle.option == "velocity" &&
           parameter.value.norm() > 0;
  };
  const auto found = std::ranges::find_if(*snapshot.sliders, is_wind);
  return found == snapshot.sliders->end() ? nullptr : &*found;
}

float radius(const View& view) {
  return pliant_render::wind_arrow_radius(view.screen.size.y());
}

}  // namespace

Vec2f WindHandle::place(const View& view) {
  return pliant_render::wind_arrow_place(view.screen.size.y());
}

bool WindHandle::is_at(const Vec2f& at, const View& view) const {
  const bool is_shown = view.live != nullptr && view.shows_wind && view.snapshot->frame.wind.has_value();
  return is_shown && (at - place(view)).norm() <= radius(view) && find_wind(*view.snapshot) != nullptr;
}

bool WindHandle::handle(const MouseEvent& event, const View& view) {
  constexpr Real stronger = 1.1;  // by a notch of the wheel
  constexpr Seconds pause{0.7};   // that makes another change of it
  switch (event.kind) {
    case MouseEvent::Kind::press: {
      if (is_held_) return true;
      if (event.button != MouseButton::left || !is_at(event.place, view)) return false;
      const Slider& wind = *find_wind(*view.snapshot);
      const Vec3f velocity = wind.parameter.value.cast<float>();
      const Vec3f direction = velocity.normalized();
      const pliant_render::Viewpoint& eye = view.screen.viewpoint;
      has_turned_ = was_outside_ = false;
      is_held_ = true;
      key_ = wind.key;
      speed_ = velocity.norm();
      side_ = direction.dot(eye.forward()) < 0 ? -1.0F : 1.0F;
      const Vec2f way = radius(view) * Vec2f(direction.dot(eye.right()), -direction.dot(eye.up));
      grip_ = place(view) + way - event.place;
      return true;
    }
    case MouseEvent::Kind::move:
      if (is_held_) turn_to(event.place, view);
      return is_held_;
    case MouseEvent::Kind::release:
      if (event.button != MouseButton::left) return is_held_;
      return std::exchange(is_held_, false);
    case MouseEvent::Kind::wheel: {
      if (is_held_) return true;
      if (!is_at(event.place, view)) return false;
      if (event.wheel == 0) return true;
      const Clock::time_point now = Clock::now();
      const bool goes_on = now - std::exchange(last_notch_, now) < pause;
      post(view, LiveScene::Kind::changes,
           [key = find_wind(*view.snapshot)->key, factor = std::pow(stronger, event.wheel), goes_on](Session& session) {
             const std::vector<Slider> all = session.sliders();
             const auto wind = std::ranges::find(all, key, &Slider::key);
             if (wind != all.end()) session.set(key, factor * wind->parameter.value, goes_on);
           });
      return true;
    }
  }
  return false;
}

void WindHandle::turn_to(const Vec2f& at, const View& view) {
  const Vec2f from_middle = (at + grip_ - place(view)) / radius(view);
  const float length = from_middle.norm();
  const bool is_outside = length > 1;
  if (was_outside_ && !is_outside) side_ = -side_;
  was_outside_ = is_outside;
  const Vec2f flat = is_outside ? Vec2f(from_middle / length) : from_middle;
  const float depth = side_ * std::sqrt(std::max(0.0F, 1 - flat.squaredNorm()));
  const pliant_render::Viewpoint& eye = view.screen.viewpoint;
  const Vec3f direction = flat.x() * eye.right() - flat.y() * eye.up + depth * eye.forward();
  send(speed_ * direction.normalized(), std::exchange(has_turned_, true), view);
}

void WindHandle::send(const Vec3f& velocity, bool goes_on, const View& view) {
  if (!velocity.allFinite()) return;
  post(view, LiveScene::Kind::changes,
       [key = key_, velocity, goes_on](Session& session) { session.set(key, velocity.cast<Real>(), goes_on); });
}

void WindHandle::draw(const View& view, bool is_hovered, ImDrawList& list) const {
  if (!is_held_ && !is_hovered) return;
  list.AddCircle(to_imgui(place(view)), radius(view), is_held_ ? amber : halo, 0, 2 * view.unit);
}

}  // namespace pliant_viewer
