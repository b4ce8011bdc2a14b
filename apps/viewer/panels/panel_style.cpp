#include "viewer/panels/panel_style.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <imgui.h>

namespace pliant_viewer {
namespace {

constexpr float label_share = 0.35F;  // of a row

/// By title; each thread has a window at most.
std::map<std::string, std::array<float, 4>>& places_of_sections() {
  thread_local std::map<std::string, std::array<float, 4>> places;
  return places;
}

void set_colors(bool is_dark) {
  ImVec4* colors = ImGui::GetStyle().Colors;
  const ImVec4 accent = is_dark ? ImVec4(0.93F, 0.46F, 0.36F, 1) : ImVec4(0.78F, 0.30F, 0.21F, 1);
  const float tone = is_dark ? 1.0F : 0.0F;
  const auto shade = [tone](float opacity) { return ImVec4(tone, tone, tone, opacity); };
  const auto tint = [&accent](float opacity) { return ImVec4(accent.x, accent.y, accent.z, opacity); };
  colors[ImGuiCol_Text] = is_dark ? ImVec4(0.93F, 0.94F, 0.95F, 1) : ImVec4(0.13F, 0.15F, 0.18F, 1);
  colors[ImGuiCol_TextDisabled] = is_dark ? ImVec4(0.63F, 0.65F, 0.69F, 1) : ImVec4(0.40F, 0.42F, 0.46F, 1);
  colors[ImGuiCol_WindowBg] = is_dark ? ImVec4(0.14F, 0.15F, 0.17F, 0.94F) : ImVec4(0.99F, 0.99F, 0.99F, 0.94F);
  colors[ImGuiCol_PopupBg] = is_dark ? ImVec4(0.17F, 0.18F, 0.20F, 0.98F) : ImVec4(1, 1, 1, 0.98F);
  colors[ImGuiCol_Border] = shade(0.10F);
  colors[ImGuiCol_FrameBg] = shade(0.06F);
  colors[ImGuiCol_FrameBgHovered] = shade(0.10F);
  colors[ImGuiCol_FrameBgActive] = shade(0.14F);
  colors[ImGuiCol_Button] = shade(0.07F);
  colors[ImGuiCol_ButtonHovered] = shade(0.12F);
  colors[ImGuiCol_ButtonActive] = shade(0.18F);
  colors[ImGuiCol_Header] = shade(0.0F);
  colors[ImGuiCol_HeaderHovered] = shade(0.06F);
  colors[ImGuiCol_HeaderActive] = shade(0.10F);
  colors[ImGuiCol_SliderGrab] = tint(0.42F);
  colors[ImGuiCol_SliderGrabActive] = accent;
  colors[ImGuiCol_CheckMark] = accent;
  colors[ImGuiCol_TextSelectedBg] = tint(0.30F);
  colors[ImGuiCol_Separator] = shade(0.10F);
  colors[ImGuiCol_ScrollbarBg] = shade(0.0F);
  colors[ImGuiCol_ScrollbarGrab] = shade(0.16F);
  colors[ImGuiCol_ScrollbarGrabHovered] = shade(0.24F);
  colors[ImGuiCol_ScrollbarGrabActive] = shade(0.32F);
}

}  // namespace

void set_panel_style(bool is_dark, float unit) {
  ImGuiStyle style;
  ImGui::GetStyle() = style;
  if (is_dark) {
    ImGui::StyleColorsDark();
  } else {
    ImGui::StyleColorsLight();
  }
  ImGuiStyle& now = ImGui::GetStyle();
  now.WindowRounding = 8;
  now.FrameRounding = now.GrabRounding = now.PopupRounding = 4;
  now.WindowPadding = {12, 10};
  now.FramePadding = {7, 2.5F};
  now.ItemSpacing = {8, 4};
  now.ItemInnerSpacing = {5, 4};
  now.IndentSpacing = 12;
  now.GrabMinSize = 7;
  now.ScrollbarSize = 10;
  now.WindowBorderSize = 1;
  now.ScaleAllSizes(unit);
  set_colors(is_dark);
}

std::string number_format(double number, const std::string& unit) {
  const double size = std::abs(number);
  std::string format = size >= 1e4 && size < 1e8 ? "%.0f" : "%.4g";
  if (unit.empty()) return format;
  format += ' ';
  for (const char c : unit) format += c == '%' ? std::string("%%") : std::string(1, c);
  return format;
}

bool section_header(const char* title, bool is_open_at_first, bool shall_open) {
  ImGui::Separator();
  if (shall_open) ImGui::SetNextItemOpen(true);
  const bool is_open = ImGui::CollapsingHeader(title, is_open_at_first ? ImGuiTreeNodeFlags_DefaultOpen : 0);
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  places_of_sections()[title] = {low.x, low.y, high.x, high.y};
  return is_open;
}

std::optional<std::array<float, 4>> section_place(const std::string& title) {
  const auto found = places_of_sections().find(title);
  if (found == places_of_sections().end()) return {};
  return found->second;
}

std::string label_of(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

void row_label(const std::string& label, const std::string& help) {
  ImGui::AlignTextToFramePadding();
  const float widget = label_share * ImGui::GetWindowWidth();
  const bool fits = ImGui::GetCursorPosX() + ImGui::CalcTextSize(label.c_str()).x < widget - 3;
  wrapped_text(label);
  explain(help);
  if (fits) ImGui::SameLine(widget);
  ImGui::SetNextItemWidth(-1);
}

void wrapped_text(const std::string& text) {
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
}

void explain(const std::string& help) {
  if (help.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  const float most = ImGui::GetIO().DisplaySize.x - 4 * ImGui::GetStyle().WindowPadding.x;
  ImGui::PushTextWrapPos(std::min(24 * ImGui::GetFontSize(), most));
  ImGui::TextUnformatted(help.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

}  // namespace pliant_viewer
