#include "viewer/panels/help_panel.h"

#include <algorithm>
#include <array>
#include <span>

#include <imgui.h>

namespace pliant_viewer {
namespace {

struct Key {
  const char* key;
  const char* what;
};

constexpr std::array<Key, 8> body_keys = {Key{"drag a body", "pull at it by a spring; it stays at its depth"},
                                          Key{"click a body", "pin the nearest vertex"},
                                          Key{"click a pin", "let it go"},
                                          Key{"drag a pin", "move it"},
                                          Key{"drag a collider", "move it; it stays where you leave it"},
                                          Key{"click a collider", "a handle moves and turns it; Esc: none"},
                                          Key{"drag with the brush", "paint (in the panel); with Shift: take it off"},
                                          Key{"drag an arrow", "turn wind, gravity or a push; wheel: its strength"}};
constexpr std::array<Key, 7> selection_keys = {
    Key{"Ctrl + drag", "select what is inside a box, or a lasso"},
    Key{"Ctrl + click", "select a vertex; twice: its border, or the rope"},
    Key{"with Shift", "take out of the selection"},
    Key{"Ctrl + A, Esc", "select everything, nothing"},
    Key{"B", "a lasso in place of a box, and back"},
    Key{"N", "pin what is selected; if it is pinned, let it go"},
    Key{"drag an arrow or a ring", "move or turn the selected pins (Ctrl then: 15°)"}};
constexpr std::array<Key, 5> camera_keys = {
    Key{"drag beside, right drag", "turn about the middle"}, Key{"middle or Shift drag", "move sideways"},
    Key{"wheel", "nearer or further away"}, Key{"F", "everything in the picture"}, Key{"Shift + F", "as at the start"}};
constexpr std::array<Key, 5> live_keys = {
    Key{"Space", "play or pause"}, Key{"S or →", "one step"}, Key{"R", "start over, with what was changed"},
    Key{"Shift + R", "start over, all as in the scene's file"}, Key{"+ and −", "stiffer or softer pull"}};
constexpr std::array<Key, 5> scene_keys = {Key{"Ctrl + Z", "take back the last change"},
                                           Key{"Ctrl + Shift + Z", "do it again"},
                                           Key{"Ctrl + S", "save the scene; with Shift under a new name"},
                                           Key{"Ctrl + R", "save the session: all that was done so far"},
                                           Key{"Ctrl + O, drop a file", "open a scene, a mesh or a run"}};
constexpr std::array<Key, 3> run_keys = {Key{"Space", "play or pause"}, Key{"→ and ←", "one frame on or back"},
                                         Key{"R", "to the first frame"}};
constexpr std::array<Key, 9> appearance_keys = {Key{"C", "color by the next quantity, or none"},
                                                Key{"W", "wireframe"},
                                                Key{"L", "smooth or flat"},
                                                Key{"O", "hide or show the colliders"},
                                                Key{"G", "plots over time"},
                                                Key{"P", "save the picture as a PNG file"},
                                                Key{"V", "film what is seen, and end that"},
                                                Key{"Tab", "hide or show the panel"},
                                                Key{"H or F1", "this help"}};

constexpr std::array<Key, 3> program_keys = {Key{"Ctrl + and −, 0", "larger and smaller panels, automatic"},
                                             Key{"Ctrl + T", "light or dark panels"}, Key{"Ctrl + Q", "end it"}};

/// Where keys and what they do stand from left to right.
struct Column {
  float left, what, right;
};

void draw_keys(const char* title, std::span<const Key> keys, const Column& column) {
  ImGui::Spacing();
  ImGui::SetCursorPosX(column.left);
  ImGui::TextDisabled("%s", title);
  for (const Key& key : keys) {
    const float top = ImGui::GetCursorPosY();
    ImGui::SetCursorPosX(column.left);
    ImGui::PushTextWrapPos(column.what - ImGui::GetStyle().ItemSpacing.x);
    ImGui::TextUnformatted(key.key);
    ImGui::PopTextWrapPos();
    const float below = ImGui::GetCursorPosY();
    ImGui::SetCursorPos({column.what, top});
    ImGui::PushTextWrapPos(column.right);
    ImGui::TextUnformatted(key.what);
    ImGui::PopTextWrapPos();
    ImGui::SetCursorPosY(std::max(below, ImGui::GetCursorPosY()));
  }
}

void draw_hand_keys(bool is_live, const Column& column) {
  if (is_live) draw_keys("bodies and colliders", body_keys, column);
  if (is_live) draw_keys("many vertices", selection_keys, column);
  draw_keys("the camera", camera_keys, column);
}

void draw_other_keys(bool is_live, const Column& column) {
  draw_keys("time", is_live ? std::span<const Key>(live_keys) : std::span<const Key>(run_keys), column);
  if (is_live) draw_keys("the scene", scene_keys, column);
  draw_keys("the picture", appearance_keys, column);
  draw_keys("the program", program_keys, column);
}

}  // namespace

bool draw_help(bool is_live, const Vec2f& picture, const PanelStyle& style) {
  bool is_open = true;
  ImGui::SetNextWindowPos({picture.x() / 2, picture.y() / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowFocus();
  ImGui::SetNextWindowBgAlpha(0.98F);
  ImGui::SetNextWindowSizeConstraints({0, 0}, {picture.x(), picture.y()});
  ImGui::Begin("Help", &is_open,
               ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoNav);
  const ImGuiStyle& spaces = ImGui::GetStyle();
  const float left = spaces.WindowPadding.x, right = picture.x() - spaces.WindowPadding.x - spaces.ScrollbarSize;
  const float keys_width = 160 * style.unit, width = 450 * style.unit;
  const bool is_wide = left + 2 * width <= right;  // in two columns all is seen at once
  const float top = ImGui::GetCursorPosY();
  const float first_right = is_wide ? left + width - 16 * style.unit : right;
  const Column first{left, left + std::min(keys_width, 0.4F * right), first_right};
  draw_hand_keys(is_live, first);
  if (is_wide) {
    const float below = ImGui::GetCursorPosY();
    ImGui::SetCursorPosY(top);
    draw_other_keys(is_live, {left + width, left + width + keys_width, left + 2 * width});
    ImGui::SetCursorPosY(std::max(below, ImGui::GetCursorPosY()));
  } else {
    draw_other_keys(is_live, first);
  }
  ImGui::Spacing();
  if (ImGui::Button("Close")) is_open = false;
  ImGui::End();
  return is_open;
}

}  // namespace pliant_viewer
