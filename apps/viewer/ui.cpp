#include "viewer/ui.h"

#include <algorithm>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <imgui_internal.h>

namespace pliant_viewer {
namespace {

constexpr float letter_height = 15;  // units

bool is_dark_color(const pliant::Color& background) {
  return 0.2126 * background.red + 0.7152 * background.green + 0.0722 * background.blue < 0.5;
}

}  // namespace

Ui::Ui(Window& window, const pliant::Color& background, const WindowSettings& settings)
    : former_context_(ImGui::GetCurrentContext()),
      context_(ImGui::CreateContext()),
      is_background_dark_(is_dark_color(background)),
      ink_(pliant_render::ink_on(background)),
      window_(window) {
  ImGui::SetCurrentContext(context_);
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().ConfigDragClickToInputText = true;
  // ImGui looks at the state of the keyboard once a frame and misses a key that is down for less: take() gives it one
  // change after another instead.
  glfwSetKeyCallback(window.handle(), nullptr);
  glfwSetCharCallback(window.handle(), nullptr);
  ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
  window.install_key_callbacks();
  ImGui_ImplOpenGL3_Init("#version 330 core");
  set_up(settings);
}

Ui::~Ui() {
  ImGui::SetCurrentContext(context_);
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext(context_);
  ImGui::SetCurrentContext(former_context_);
}

void Ui::set_up(const WindowSettings& settings) {
  const std::array<int, 2> pixels = window_.framebuffer_size();
  const float pixels_a_unit = static_cast<float>(pixels[0]) / window_.size().x();
  if (!(pixels_a_unit > 0) && font_ != nullptr) return;  // minimized
  const float scale = settings.scale > 0 ? settings.scale : automatic_scale(window_.content_scale(), pixels);
  const bool shall_be_dark = settings.theme == Theme::automatic ? is_background_dark_ : settings.theme == Theme::dark;
  // Where the mouse counts in larger units than pixels, letters are as large in these.
  const float unit = pixels_a_unit > 0 ? scale / pixels_a_unit : scale;
  if (scale == scale_ && unit == style_.unit && shall_be_dark == is_dark_ && font_ != nullptr) return;
  ImGui::SetCurrentContext(context_);
  load_letters(letter_height * scale);
  if (pixels_a_unit > 0) ImGui::GetIO().FontGlobalScale = 1 / pixels_a_unit;
  scale_ = scale;
  is_dark_ = shall_be_dark;
  style_.unit = unit;
  set_panel_style(shall_be_dark, unit);
}

void Ui::load_letters(float height) {
  if (height == letters_) return;
  letters_ = height;
  const bool has_texture = font_ != nullptr;  // else the first frame makes it
  ImGui::GetIO().Fonts->Clear();
  font_ = pliant_render::load_font(height, pliant_render::Letters::with_symbols);
  if (!has_texture) return;
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

void Ui::begin() {
  ImGui::SetCurrentContext(context_);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  keys_changed_.clear();
  has_command_waiting_ = false;
}

bool Ui::take(const KeyEvent& event) {
  ImGui::SetCurrentContext(context_);
  GLFWwindow* handle = window_.handle();
  const bool is_release = event.kind == KeyEvent::Kind::release;
  const bool is_modifier = event.key >= GLFW_KEY_LEFT_SHIFT && event.key <= GLFW_KEY_RIGHT_SUPER;
  const bool is_down = std::ranges::find(keys_down_, event.key) != keys_down_.end();
  if (is_release ? !is_down : !is_modifier && !takes_text()) return true;  // of no use to a panel
  // In a frame the panels take characters before commands, so nothing may follow a command.
  if (has_command_waiting_ && !is_release) return false;
  if (event.kind == KeyEvent::Kind::character) {
    ImGui_ImplGlfw_CharCallback(handle, event.character);
    return true;
  }
  if (std::ranges::find(keys_changed_, event.key) != keys_changed_.end()) return false;
  keys_changed_.push_back(event.key);
  if (is_release) {
    std::erase(keys_down_, event.key);
  } else if (!is_down) {
    keys_down_.push_back(event.key);
  }
  const bool has_control = (event.modifiers & GLFW_MOD_CONTROL) != 0;
  if (!is_release && !is_modifier && (event.key >= GLFW_KEY_ESCAPE || has_control)) has_command_waiting_ = true;
  const int action = is_release ? GLFW_RELEASE : event.kind == KeyEvent::Kind::repeat ? GLFW_REPEAT : GLFW_PRESS;
  ImGui_ImplGlfw_KeyCallback(handle, event.key, event.scancode, action, event.modifiers);
  return true;
}

void Ui::end() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Ui::has_panel_at(const Vec2f& place) const {
  for (const ImGuiWindow* panel : context_->Windows) {
    if (!panel->WasActive || panel->Hidden || (panel->Flags & ImGuiWindowFlags_NoInputs) == ImGuiWindowFlags_NoInputs) {
      continue;
    }
    if (panel->Rect().Contains({place.x(), place.y()})) return true;
  }
  return false;
}

Vec2f Ui::mouse() const {
  return {context_->IO.MousePos.x, context_->IO.MousePos.y};
}

void Ui::show_hand() {
  ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
}

bool Ui::holds_mouse() const {
  return context_->ActiveId != 0 || !context_->OpenPopupStack.empty();
}

bool Ui::close_menus() {
  ImGui::SetCurrentContext(context_);
  if (context_->OpenPopupStack.empty()) return false;
  ImGui::ClosePopupToLevel(0, true);
  return true;
}

bool Ui::takes_text() const {
  return context_->ActiveId != 0 && context_->ActiveId == context_->InputTextState.ID;
}

pliant_render::AnnotationCanvas Ui::canvas(const Vec2f& picture) const {
  return {*ImGui::GetBackgroundDrawList(), *font_, ink_, picture.x(), picture.y()};
}

pliant_render::Vec3f Ui::panel_color() const {
  const ImVec4& color = context_->Style.Colors[ImGuiCol_WindowBg];
  return {color.x, color.y, color.z};
}

}  // namespace pliant_viewer
