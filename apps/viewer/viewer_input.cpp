// What keys and mouse do in the window.
#include <algorithm>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "viewer/viewer.h"

namespace pliant_viewer {
namespace {

constexpr double stiffer = 1.5;  // per key press

/// What the key writes on this keyboard, where it writes one letter.
char letter_of(const KeyEvent& event) {
  const char* name = glfwGetKeyName(event.key, event.scancode);
  if (name == nullptr || name[0] == '\0' || name[1] != '\0') return '\0';
  return name[0] >= 'A' && name[0] <= 'Z' ? static_cast<char>(name[0] - 'A' + 'a') : name[0];
}

}  // namespace

MouseInteraction::View Viewer::mouse_view() {
  LiveScene* live = source_.live();
  const auto& colliders = source_.frame().content.colliders;
  const auto is_seen_plane = [this](const auto& each) { return appearance_.colliders && each.surface->is_plane; };
  std::optional<float> floor;
  if (std::ranges::any_of(colliders, is_seen_plane)) {
    floor = pliant_render::floor_height(colliders);
  } else if (appearance_.ground) {
    floor = ground_height_;
  }
  if (!(appearance_.camera.up.normalized().z() > 0.999)) floor.reset();
  return {screen_,
          camera_,
          live,
          live != nullptr ? &live->shown() : nullptr,
          ui_.style().unit,
          floor,
          appearance_.colliders,
          appearance_.wind_arrow,
          is_panel_open_ && source_.shows_forces()};
}

void Viewer::take_input() {
  take_keys();
  for (const MouseEvent& event : window_.take_mouse_events()) {
    const bool begins = event.kind == MouseEvent::Kind::press || event.kind == MouseEvent::Kind::wheel;
    const bool is_busy = interaction_.is_busy() || handles_.is_busy() || select_.is_busy() || brush_.is_busy();
    if (begins && !is_busy && (ui_.has_panel_at(event.place) || ui_.holds_mouse())) continue;
    const MouseInteraction::View view = mouse_view();
    const bool is_taken = !interaction_.is_busy() &&
                          (handles_.handle(event, view) || select_.handle(event, view) || brush_.handle(event, view));
    if (!is_taken) interaction_.handle(event, view);
    if (const auto click = interaction_.take_click(); click && view.snapshot != nullptr) {
      handles_.take_click(*click, *view.snapshot);
    }
    screen_.viewpoint = camera_.viewpoint(bounds_, screen_.viewpoint.inset);
  }
  interaction_.flush(mouse_view());
  handles_.flush(mouse_view());
}

/// Gives each key to a field that is being typed into, or else to the shortcuts, in order: what follows the Enter that
/// ends a field waits until the field has ended.
void Viewer::take_keys() {
  for (const KeyEvent& event : window_.take_key_events()) keys_.push_back(event);
  while (!keys_.empty() && ui_.take(keys_.front())) {
    const KeyEvent event = keys_.front();
    keys_.pop_front();
    const bool is_down = event.kind == KeyEvent::Kind::press || event.kind == KeyEvent::Kind::repeat;
    if (is_down && !ui_.takes_text()) take_key(event);
  }
  if (!keys_.empty()) draws_left_ = std::max(draws_left_, 2);  // this picture, and one without a wait
}

void Viewer::take_key(const KeyEvent& event) {
  const bool has_control = (event.modifiers & GLFW_MOD_CONTROL) != 0;
  const bool has_shift = (event.modifiers & GLFW_MOD_SHIFT) != 0;
  const bool is_repeated = event.kind == KeyEvent::Kind::repeat;
  if (has_control && takes_window_key(event.key, letter_of(event))) return;
  LiveScene* live = source_.live();
  if (event.key == GLFW_KEY_RIGHT || (event.key == GLFW_KEY_S && !has_control)) {
    // A key that is held asks for no more steps than are taken; each press asks for one.
    if (!is_repeated || !source_.is_stepping()) source_.step(1);
    return;
  }
  if (event.key == GLFW_KEY_LEFT) return source_.step(-1);
  if (event.key == GLFW_KEY_EQUAL || event.key == GLFW_KEY_KP_ADD || event.key == GLFW_KEY_RIGHT_BRACKET) {
    if (live != nullptr) interaction_.set_stiffness(std::min(interaction_.stiffness() * stiffer, 1e9), *live);
    return;
  }
  if (event.key == GLFW_KEY_MINUS || event.key == GLFW_KEY_KP_SUBTRACT || event.key == GLFW_KEY_SLASH) {
    if (live != nullptr) interaction_.set_stiffness(std::max(interaction_.stiffness() / stiffer, 1e-3), *live);
    return;
  }
  if (is_repeated && !has_control) return;
  if (has_control) return take_control_key(letter_of(event), has_shift, is_repeated);
  take_plain_key(event.key, has_shift);
}

/// With Ctrl: how large and how dark the panels are.
bool Viewer::takes_window_key(int key, char letter) {
  const WindowSettings before = settings_;
  if (letter == '+' || letter == '=' || key == GLFW_KEY_KP_ADD) {
    settings_.scale = next_scale(ui_.scale(), true);
  } else if (letter == '-' || key == GLFW_KEY_KP_SUBTRACT) {
    settings_.scale = next_scale(ui_.scale(), false);
  } else if (letter == '0' || key == GLFW_KEY_KP_0) {
    settings_.scale = 0;
  } else if (letter == 't') {
    settings_.theme = ui_.is_dark() ? Theme::light : Theme::dark;
  } else {
    return false;
  }
  if (!(settings_ == before)) write_window_settings(settings_file_, settings_);
  return true;
}

void Viewer::take_plain_key(int key, bool has_shift) {
  switch (key) {
    case GLFW_KEY_SPACE:
      return source_.play(!source_.is_playing());
    case GLFW_KEY_R:
      return source_.restart(!has_shift);
    case GLFW_KEY_F:
      return has_shift ? view_as_at_first() : frame_everything();
    case GLFW_KEY_C:
      return toggle_color();
    case GLFW_KEY_W:
      appearance_.wireframe = !appearance_.wireframe;
      return;
    case GLFW_KEY_L:
      appearance_.shading =
          appearance_.shading == pliant::Shading::flat ? pliant::Shading::smooth : pliant::Shading::flat;
      return;
    case GLFW_KEY_O:
      appearance_.colliders = !appearance_.colliders;
      return;
    case GLFW_KEY_G:
      plots_panel_.is_open = !plots_panel_.is_open;
      return;
    case GLFW_KEY_N:
      return toggle_pins();
    case GLFW_KEY_B:
      return change_select_shape();
    case GLFW_KEY_P:
      return save_picture();
    case GLFW_KEY_V:
      return toggle_film();
    case GLFW_KEY_TAB:
      is_panel_open_ = !is_panel_open_;
      return;
    case GLFW_KEY_H:
    case GLFW_KEY_F1:
      is_help_open_ = !is_help_open_;
      return;
    case GLFW_KEY_ESCAPE:
      if (ui_.close_menus()) return;
      if (brush_.is_on() && !is_help_open_ && !scene_panel_.is_open) return choose_brush({});
      if (!is_help_open_ && !scene_panel_.is_open) {
        select_.clear();
        handles_.collider.select("");
      }
      is_help_open_ = false;
      scene_panel_.is_open = false;
      return;
    default:
      return;
  }
}

void Viewer::take_control_key(char letter, bool has_shift, bool is_repeated) {
  if (letter == 'z') return has_shift ? redo() : undo();
  if (letter == 'y') return redo();
  if (is_repeated) return;
  if (letter == 's') return save_scene(has_shift);
  if (letter == 'r') return save_session();
  if (letter == 'a' && render_mesh_ != nullptr && source_.live() != nullptr) select_.select_all(*render_mesh_);
  if (letter == 'o') scene_panel_.is_open = !scene_panel_.is_open && open_ != nullptr;
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
    appearance_.color = static_cast<pliant::ColorBy>((static_cast<int>(appearance_.color) + 1) % count);
  } while (!source_.knows(appearance_.color));
  change_color();
}

void Viewer::change_color() {
  source_.show(appearance_.color);
  is_frame_new_ = true;
}

}  // namespace pliant_viewer
