// What keys and the mouse do in the window.
#include <algorithm>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "viewer/viewer.h"

namespace pliant_viewer {
namespace {

constexpr double stiffer = 1.5;  // a key

}  // namespace

Hand::Place Viewer::place_of_mouse() {
  LiveScene* live = stage_.live();
  const bool has_floor = look_.ground && look_.camera.up.normalized().z() > 0.999;
  return {screen_,
          camera_,
          live,
          live != nullptr ? &live->shown() : nullptr,
          ui_.style().unit,
          has_floor ? std::optional(ground_height_) : std::nullopt};
}

void Viewer::take_input() {
  for (const KeyEvent& event : window_.take_key_events()) {
    if (!ui_.takes_text()) take_key(event);
  }
  for (const MouseEvent& event : window_.take_mouse_events()) {
    const bool begins = event.kind == MouseEvent::Kind::press || event.kind == MouseEvent::Kind::wheel;
    if (begins && !hand_.is_busy() && (ui_.has_panel_at(event.place) || ui_.holds_mouse())) continue;
    hand_.handle(event, place_of_mouse());
    screen_.viewpoint = camera_.viewpoint(bounds_, screen_.viewpoint.inset);
  }
  hand_.flush(place_of_mouse());
}

void Viewer::take_key(const KeyEvent& event) {
  LiveScene* live = stage_.live();
  if (event.key == GLFW_KEY_RIGHT || (event.key == GLFW_KEY_S && !event.control)) return stage_.step(1);
  if (event.key == GLFW_KEY_LEFT) return stage_.step(-1);
  if (event.key == GLFW_KEY_EQUAL || event.key == GLFW_KEY_KP_ADD || event.key == GLFW_KEY_RIGHT_BRACKET) {
    if (live != nullptr) hand_.set_stiffness(std::min(hand_.stiffness() * stiffer, 1e9), *live);
    return;
  }
  if (event.key == GLFW_KEY_MINUS || event.key == GLFW_KEY_KP_SUBTRACT || event.key == GLFW_KEY_SLASH) {
    if (live != nullptr) hand_.set_stiffness(std::max(hand_.stiffness() / stiffer, 1e-3), *live);
    return;
  }
  if (event.is_repeated) return;
  switch (event.key) {
    case GLFW_KEY_SPACE:
      return stage_.play(!stage_.is_playing());
    case GLFW_KEY_R:
      return stage_.restart(!event.shift);
    case GLFW_KEY_F:
      return event.shift ? view_as_at_first() : frame_everything();
    case GLFW_KEY_C:
      return toggle_color();
    case GLFW_KEY_W:
      look_.wireframe = !look_.wireframe;
      return;
    case GLFW_KEY_L:
      look_.shading = look_.shading == pliant::Shading::flat ? pliant::Shading::smooth : pliant::Shading::flat;
      return;
    case GLFW_KEY_P:
      return save_picture();
    case GLFW_KEY_TAB:
      is_panel_open_ = !is_panel_open_;
      return;
    case GLFW_KEY_H:
    case GLFW_KEY_F1:
      is_help_open_ = !is_help_open_;
      return;
    case GLFW_KEY_ESCAPE:
      is_help_open_ = false;
      return;
    case GLFW_KEY_Q:
      if (event.control) window_.close();
      return;
    default:
      return;
  }
}

void Viewer::view_as_at_first() {
  camera_ = first_camera_;
}

void Viewer::frame_everything() {
  has_ground_ = false;
  update_bounds();
  camera_.frame(bounds_, screen_.aspect(), screen_.viewpoint.inset);
}

void Viewer::toggle_color() {
  const auto count = static_cast<int>(choice_names(pliant::ColorBy{}).size());
  do {
    look_.color = static_cast<pliant::ColorBy>((static_cast<int>(look_.color) + 1) % count);
  } while (!stage_.knows(look_.color));
  change_color();
}

void Viewer::change_color() {
  stage_.show(look_.color);
  is_frame_new_ = true;
}

}  // namespace pliant_viewer
