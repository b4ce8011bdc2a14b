#include "viewer/force_arrows.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "pliant/forces/gravity.h"
#include "pliant/forces/test_force.h"
#include "pliant/forces/wind.h"
#include "viewer/drawing.h"
#include "viewer/panels/panel_style.h"
#include "viewer/rounding.h"

namespace pliant_viewer {
namespace {

using View = MouseInteraction::View;
using Arrow = ForceArrows::Arrow;

constexpr float small_arrow = 0.7F;     // size of an arrow beside that of the wind
constexpr float arrow_distance = 2.5F;  // from one to the next, in its radii
constexpr std::size_t most_arrows = 4;  // beside the wind
constexpr float highest_arrow = 0.3F;   // of the picture: above are none

bool is_vector(const pliant::Parameter& parameter, std::string_view type, std::string_view option) {
  return parameter.type == type && parameter.handle.option == option && parameter.value.norm() > 0;
}

bool has_small_arrow(const pliant::Parameter& parameter) {
  return is_vector(parameter, pliant::Gravity::info.name, "acceleration") ||
         (is_vector(parameter, pliant::TestForce::info.name, "force") &&
          parameter.kind == pliant::ParameterKind::vector);
}

std::vector<Arrow> list_all(const View& view) {
  std::vector<Arrow> list;
  if (view.live == nullptr || view.snapshot->sliders == nullptr) return list;
  const std::vector<Slider>& sliders = *view.snapshot->sliders;
  const float height = view.screen.size.y();
  const Vec2f first = pliant_render::wind_arrow_place(height);
  const float radius = pliant_render::wind_arrow_radius(height);
  const auto wind = std::ranges::find_if(
      sliders, [](const Slider& each) { return is_vector(each.parameter, pliant::Wind::info.name, "velocity"); });
  if (view.shows_wind && view.snapshot->frame.wind && wind != sliders.end()) {
    list.push_back({wind->key, wind->parameter.value.cast<float>(), "", first, radius, true});
  }
  std::size_t count = 0;
  for (const Slider& each : sliders) {
    if (count == most_arrows || !has_small_arrow(each.parameter)) continue;
    const float up = radius * (1.3F + small_arrow * arrow_distance * (0.5F + static_cast<float>(count)));
    const Vec2f middle(first.x() - (1 - small_arrow) * radius, first.y() - up);
    if (middle.y() < highest_arrow * height) break;
    ++count;
    const pliant::Parameter& parameter = each.parameter;
    list.push_back({each.key, parameter.value.cast<float>(),
                    fmt::format("{} {:.3g} {}", label_of(parameter.name), parameter.value.norm(), parameter.unit),
                    middle, small_arrow * radius, false});
  }
  return list;
}

}  // namespace

std::vector<Arrow> ForceArrows::list(const View& view) {
  std::vector<Arrow> arrows = list_all(view);
  if (!view.shows_forces) std::erase_if(arrows, [](const Arrow& arrow) { return !arrow.is_of_wind; });
  return arrows;
}

std::optional<Arrow> ForceArrows::at(const Vec2f& place, const View& view) {
  for (const Arrow& arrow : list_all(view)) {
    if ((place - arrow.middle).norm() > arrow.radius) continue;
    if (arrow.is_of_wind || view.shows_forces) return arrow;
    const MouseInteraction::PickTarget seen = MouseInteraction::pick(place, view);
    if (!seen.pin && !seen.point && !seen.collider) return arrow;
  }
  return {};
}

bool ForceArrows::handle(const MouseEvent& event, const View& view) {
  constexpr Real stronger = 1.1;  // by a notch of the wheel
  constexpr Seconds pause{0.7};   // that makes another change of it
  switch (event.kind) {
    case MouseEvent::Kind::press: {
      if (is_busy()) return true;
      const bool is_plain = event.button == MouseButton::left && !event.shift && !event.control;
      const auto arrow = is_plain ? at(event.place, view) : std::nullopt;
      if (arrow) take(*arrow, event.place, view);
      return arrow.has_value();
    }
    case MouseEvent::Kind::move:
      if (is_busy()) turn_to(event.place, view);
      return is_busy();
    case MouseEvent::Kind::release:
      if (event.button != MouseButton::left) return is_busy();
      return std::exchange(held_, std::nullopt).has_value();
    case MouseEvent::Kind::wheel: {
      if (is_busy()) return true;
      const auto arrow = at(event.place, view);
      if (!arrow || event.wheel == 0) return arrow.has_value();
      const Clock::time_point now = Clock::now();
      const bool is_soon = now - std::exchange(last_notch_, now) < pause;
      const bool goes_on = std::exchange(last_key_, arrow->key) == arrow->key && is_soon;
      post(view, LiveScene::Kind::changes,
           [key = arrow->key, factor = std::pow(stronger, event.wheel), goes_on](Session& session) {
             const std::vector<Slider> all = session.sliders();
             const auto force = std::ranges::find(all, key, &Slider::key);
             if (force != all.end()) session.set(key, with_digits(factor * force->parameter.value, 5), goes_on);
           });
      return true;
    }
  }
  return false;
}

void ForceArrows::take(const Arrow& arrow, const Vec2f& at, const View& view) {
  const Vec3f direction = arrow.vector.normalized();
  const pliant_render::Viewpoint& eye = view.screen.viewpoint;
  held_ = arrow;
  has_turned_ = was_outside_ = false;
  side_ = direction.dot(eye.forward()) < 0 ? -1.0F : 1.0F;
  const Vec2f way = arrow.radius * Vec2f(direction.dot(eye.right()), -direction.dot(eye.up));
  grip_ = arrow.middle + way - at;
}

void ForceArrows::turn_to(const Vec2f& at, const View& view) {
  const Vec2f from_middle = (at + grip_ - held_->middle) / held_->radius;
  const float length = from_middle.norm();
  const bool is_outside = length > 1;
  if (was_outside_ && !is_outside) side_ = -side_;
  was_outside_ = is_outside;
  const Vec2f flat = is_outside ? Vec2f(from_middle / length) : from_middle;
  const float depth = side_ * std::sqrt(std::max(0.0F, 1 - flat.squaredNorm()));
  const pliant_render::Viewpoint& eye = view.screen.viewpoint;
  const Vec3f direction = flat.x() * eye.right() - flat.y() * eye.up + depth * eye.forward();
  const Vec3f turned = held_->vector.norm() * direction.normalized();
  if (!turned.allFinite()) return;
  post(view, LiveScene::Kind::changes,
       [key = held_->key, turned, goes_on = std::exchange(has_turned_, true)](Session& session) {
         session.set(key, with_digits(turned.cast<Real>(), 5), goes_on);
       });
}

void ForceArrows::draw(const View& view, const std::optional<Arrow>& hovered,
                       const pliant_render::AnnotationCanvas& canvas) const {
  const std::string lit = held_ ? held_->key : hovered ? hovered->key : "";
  for (const Arrow& arrow : list_all(view)) {
    const bool is_lit = arrow.key == lit;
    if (is_lit) {
      canvas.list.AddCircle(to_imgui(arrow.middle), arrow.radius, held_ ? amber : halo, 0, 2 * view.unit);
    }
    if (arrow.is_of_wind || (!view.shows_forces && !is_lit)) continue;
    draw_arrow({arrow.vector, arrow.text}, {arrow.middle, arrow.radius}, view.screen.viewpoint, canvas);
  }
}

}  // namespace pliant_viewer
