#include "viewer/panels/number_slider.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "viewer/panels/panel_style.h"

namespace pliant_viewer {
namespace {

constexpr const char* all_digits = "%.7g";  // while a number is typed

std::string printed(double value, const std::string& format) {
  std::vector<char> text(64 + format.size());
  ImFormatString(text.data(), text.size(), format.c_str(), value);
  return text.data();
}

std::string shown_text(double value, const NumberSlider& slider) {
  if (!slider.is_whole) return printed(value, number_format(value, slider.unit));
  return fmt::format("{:.0f}{}{}", value, slider.unit.empty() ? "" : " ", slider.unit);
}

float text_width(const std::string& text) {
  return ImGui::CalcTextSize(text.c_str()).x;
}

/// Of the number, such that none over the whole slider is cut, and the slider stays as long as it is while it moves.
float number_width(double value, const NumberSlider& slider) {
  float widest = text_width(shown_text(value, slider));
  if (slider.low < slider.high) {
    widest = std::max(
        {widest, text_width(shown_text(slider.low, slider)), text_width(shown_text(slider.high, slider)),
         slider.is_whole ? 0.0F : text_width(shown_text(slider.low + 0.5678 * (slider.high - slider.low), slider))});
    for (double decade = slider.low; slider.is_logarithmic && slider.low > 0 && decade < slider.high; decade *= 10) {
      widest = std::max(widest, text_width(shown_text(1.234 * decade, slider)));
    }
  }
  return std::max(5.2F * ImGui::GetFontSize(), widest + 2 * ImGui::GetStyle().FramePadding.x);
}

std::array<float, 4> last_place() {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  return {low.x, low.y, high.x, high.y};
}

bool is_typed_into(const char* id) {
  return ImGui::TempInputIsActive(ImGui::GetID(id));
}

/// A field whose text is drawn by us, as far to the right (1) or in the middle (0.5) as is asked for.
bool number_field(const char* id, double& value, const std::string& text, float speed, const NumberSlider& limits,
                  float alignment) {
  const bool is_hidden = !is_typed_into(id);
  if (is_hidden) ImGui::PushStyleColor(ImGuiCol_Text, 0);
  const bool is_dragged = ImGui::IsMouseDragging(ImGuiMouseButton_Left);
  const char* const format = limits.is_whole ? "%.0f" : is_dragged ? "%.4g" : all_digits;
  bool has_changed = ImGui::DragScalar(id, ImGuiDataType_Double, &value, speed, &limits.least, &limits.most, format);
  if (is_hidden) ImGui::PopStyleColor();
  if (limits.is_whole) value = std::round(value);
  if (!is_hidden || is_typed_into(id)) return has_changed;
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const ImVec2 space = ImGui::GetStyle().FramePadding;
  ImGui::RenderTextClipped({low.x + space.x, low.y}, {high.x - space.x, high.y}, text.c_str(), nullptr, nullptr,
                           {alignment, 0.5F});
  return has_changed;
}

/// The slider alone; what it shows while someone types into it is the text.
bool bare_slider(const char* id, double& value, const NumberSlider& slider) {
  const bool is_hidden = !is_typed_into(id);
  if (is_hidden) ImGui::PushStyleColor(ImGuiCol_Text, 0);
  // As many decades as the format has digits go by powers of ten, those below are skipped.
  const int flags = slider.is_logarithmic ? ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoRoundToFormat : 0;
  const std::string format = slider.is_logarithmic ? "%.15g" : number_format(value, slider.unit);
  bool has_changed = false;
  if (slider.is_whole) {
    int whole = static_cast<int>(std::min(value, 1e9));
    has_changed = ImGui::SliderInt(id, &whole, static_cast<int>(slider.low), static_cast<int>(slider.high), "%d",
                                   ImGuiSliderFlags_Logarithmic);
    if (has_changed) value = whole;
  } else {
    has_changed =
        ImGui::SliderScalar(id, ImGuiDataType_Double, &value, &slider.low, &slider.high, format.c_str(), flags);
    if (has_changed && is_hidden) value = std::strtod(printed(value, "%.4g").c_str(), nullptr);  // as it is shown
  }
  if (is_hidden) ImGui::PopStyleColor();
  return has_changed;
}

/// With fewer digits where there is no room for more.
std::string fitting_text(double value, float width) {
  std::string text;
  for (int digits = 4; digits > 0; --digits) {
    text = printed(value, fmt::format("%.{}g", digits));
    if (text_width(text) <= width) break;
  }
  return text;
}

}  // namespace

bool number_slider(const char* id, double& value, const NumberSlider& slider, NumberPlaces* places) {
  const float whole = ImGui::CalcItemWidth(), gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const bool has_slider = slider.low < slider.high;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.3F * ImGui::GetFontSize(), ImGui::GetStyle().FramePadding.y});
  const float number = number_width(value, slider);
  ImGui::BeginGroup();
  ImGui::PushID(id);
  bool has_changed = false;
  if (has_slider) {
    ImGui::SetNextItemWidth(std::max(1.5F * ImGui::GetFontSize(), whole - number - gap));
    has_changed = bare_slider("##slider", value, slider);
    if (places != nullptr) places->slider = last_place();
    ImGui::SameLine(0, gap);
  }
  ImGui::SetNextItemWidth(has_slider ? number : whole);
  const double from_zero = slider.low > 0 ? 0.01 * slider.low : slider.unit.empty() ? 1e-3 : 1e-4;
  const double step = slider.is_whole ? 0.1 : value != 0 ? 0.01 * std::abs(value) : from_zero;
  has_changed |= number_field("##number", value, shown_text(value, slider), static_cast<float>(step), slider, 1);
  if (places != nullptr) {
    places->number = last_place();
    if (!has_slider) places->slider = places->number;
  }
  ImGui::PopID();
  ImGui::EndGroup();
  ImGui::PopStyleVar();
  return has_changed;
}

bool vector_fields(const char* id, double* values, float speed, const std::string& unit) {
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x, width = (ImGui::CalcItemWidth() - 2 * gap) / 3;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.2F * ImGui::GetFontSize(), ImGui::GetStyle().FramePadding.y});
  const float room = width - 2 * ImGui::GetStyle().FramePadding.x;
  bool has_changed = false;
  ImGui::BeginGroup();
  ImGui::PushID(id);
  for (int i = 0; i < 3; ++i) {
    if (i > 0) ImGui::SameLine(0, gap);
    ImGui::PushID(i);
    ImGui::SetNextItemWidth(width);
    has_changed |= number_field("##number", values[i], fitting_text(values[i], room), speed, {}, 0.5F);
    ImGui::PopID();
  }
  ImGui::PopID();
  ImGui::EndGroup();
  ImGui::PopStyleVar();
  explain(fmt::format("x, y, z: {:.7g}, {:.7g}, {:.7g}{}{}", values[0], values[1], values[2], unit.empty() ? "" : " ",
                      unit));
  return has_changed;
}

void vector_text(const std::array<double, 3>& values, const std::string& unit, const std::string& help) {
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x, whole = ImGui::CalcItemWidth();
  const float width = (whole - 2 * gap) / 3, height = ImGui::GetFrameHeight();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::Dummy({whole, height});
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string text = fitting_text(values[i], width);
    const float left = corner.x + static_cast<float>(i) * (width + gap);
    ImGui::RenderTextClipped({left, corner.y}, {left + width, corner.y + height}, text.c_str(), nullptr, nullptr,
                             {0.5F, 0.5F});
  }
  explain(fmt::format("{}\nx, y, z: {:.5g}, {:.5g}, {:.5g} {}", help, values[0], values[1], values[2], unit));
}

std::string label_with_unit(const std::string& label, const std::string& unit) {
  return unit.empty() ? label : label + " [" + unit + "]";
}

}  // namespace pliant_viewer
