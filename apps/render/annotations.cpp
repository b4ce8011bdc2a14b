#include "render/annotations.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <imgui.h>

#include "render/scalar_fields.h"

namespace pliant_render {
namespace {

/// The first one that exists is used.
constexpr std::array<const char*, 4> fonts = {"/usr/share/fonts/opentype/inter/Inter-Medium.otf",
                                              "/usr/share/fonts/opentype/inter/static/Inter-Medium.otf",
                                              "/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Medium.ttf",
                                              "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"};

/// Scale of lengths laid out for a picture of 720 rows; text stays readable in small pictures.
float unit_of(float height) {
  return std::max(height / 720, 0.65F);
}

}  // namespace

std::uint32_t ink_on(const pliant::Color& background) {
  const double light = 0.2126 * background.red + 0.7152 * background.green + 0.0722 * background.blue;
  return light > 0.5 ? IM_COL32(38, 42, 50, 255) : IM_COL32(232, 234, 238, 255);
}

ImFont* load_font(float pixels, Letters letters) {
  // Latin, Greek, punctuation with super- and subscripts, arrows, operators.
  static constexpr std::array<ImWchar, 11> symbols = {0x20,   0x17F,  0x370,  0x3FF,  0x1E00, 0x1EFF,
                                                      0x2000, 0x209F, 0x2190, 0x22FF, 0};
  ImFontConfig config;
  if (letters == Letters::with_symbols) config.GlyphRanges = symbols.data();
  config.OversampleH = config.OversampleV = 1;
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  for (const char* file : fonts) {
    if (!std::filesystem::exists(file)) continue;
    if (ImFont* font = atlas.AddFontFromFileTTF(file, pixels, &config)) return font;
  }
  config.SizePixels = pixels;
  return atlas.AddFontDefault(&config);
}

float legend_width(int height) {
  return 122 * unit_of(static_cast<float>(height));
}

std::optional<Legend> make_legend(const pliant::ViewSettings& appearance, const std::array<float, 2>& range, int width,
                                  int height) {
  if (!appearance.legend || appearance.color == pliant::ColorBy::none) return {};
  if (legend_width(height) > 0.4F * static_cast<float>(width)) return {};
  return Legend{std::string(field_title(appearance.color)), range, field_scale(appearance.color),
                color_map(appearance.color)};
}

std::vector<float> round_ticks(float low, float high) {
  if (!(high > low) || !std::isfinite(high - low)) return {low};
  const float rough = (high - low) / 4;
  const float power = std::pow(10.0F, std::floor(std::log10(rough)));
  float step = 10 * power;
  for (const float factor : {1.0F, 2.0F, 2.5F, 5.0F}) {
    if (factor * power >= rough) {
      step = factor * power;
      break;
    }
  }
  const float slack = 1e-4F * (high - low);
  const float first = std::ceil((low - slack) / step) * step;
  if (!(low + step > low) || !(first + step > first)) return {low};  // beyond a float's precision
  constexpr int most_ticks = 10;
  std::vector<float> ticks;
  for (int i = 0; i < most_ticks && first + static_cast<float>(i) * step <= high + slack; ++i) {
    const float tick = first + static_cast<float>(i) * step;
    ticks.push_back(std::abs(tick) < slack ? 0 : tick);
  }
  return ticks;
}

std::string tick_text(float tick, float step) {
  constexpr int most_digits = 4;
  int digits = 0;
  for (float scaled = step; digits <= most_digits; scaled *= 10, ++digits) {
    if (std::abs(scaled - std::round(scaled)) < 1e-3F * scaled) break;
  }
  if (digits > most_digits || std::abs(tick) >= 1e5F) return fmt::format("{:.3g}", tick);
  return fmt::format("{:.{}f}", tick, digits);
}

/// Draws a bar at the right edge, with ticks on its left and the title above.
void draw_legend(const Legend& legend, const AnnotationCanvas& canvas) {
  const float unit = unit_of(canvas.height);
  const float size = 17 * unit;
  const float bar_width = 16 * unit, bar_height = 0.4F * canvas.height;
  const float right = canvas.width - 28 * unit, top = 0.30F * canvas.height;
  const float left = right - bar_width, bottom = top + bar_height;
  const auto count = static_cast<float>(legend.colors.size());
  for (std::size_t i = 0; i < legend.colors.size(); ++i) {
    const auto& c = legend.colors[i];
    const float from = bottom - bar_height * static_cast<float>(i) / count;
    const float to = bottom - bar_height * static_cast<float>(i + 1) / count;
    canvas.list.AddRectFilled({left, to}, {right, from + 0.5F}, IM_COL32(c[0], c[1], c[2], 255));
  }
  const auto text_width = [&](const std::string& text) {
    return canvas.font.CalcTextSizeA(size, 1e6F, 0, text.c_str()).x;
  };
  const float low = legend.range[0] * legend.factor, high = legend.range[1] * legend.factor;
  const std::vector<float> ticks = round_ticks(low, high);
  const float step = ticks.size() > 1 ? ticks[1] - ticks[0] : std::max(std::abs(high), 1e-6F);
  for (const float tick : ticks) {
    const float y = bottom - bar_height * (high > low ? (tick - low) / (high - low) : 0.5F);
    const std::string text = tick_text(tick, step);
    canvas.list.AddLine({left - 5 * unit, y}, {left, y}, canvas.ink, std::max(1.0F, unit));
    canvas.list.AddText(&canvas.font, size, {left - 9 * unit - text_width(text), y - size * 0.5F}, canvas.ink,
                        text.c_str());
  }
  canvas.list.AddText(&canvas.font, size, {right - text_width(legend.title), top - 1.9F * size}, canvas.ink,
                      legend.title.c_str());
}

Vec2f wind_arrow_place(float height) {
  const float unit = unit_of(height);
  return {56 * unit, height - 56 * unit};
}

float wind_arrow_radius(float height) {
  return 38 * unit_of(height);
}

/// At the lower left.
void draw_wind(const WindAnnotation& wind, const Viewpoint& viewpoint, const AnnotationCanvas& canvas) {
  draw_arrow({wind.velocity, wind.text}, {wind_arrow_place(canvas.height), wind_arrow_radius(canvas.height)}, viewpoint,
             canvas);
}

void draw_arrow(const ArrowAnnotation& arrow, const ArrowPlace& place, const Viewpoint& viewpoint,
                const AnnotationCanvas& canvas) {
  const float unit = place.radius / 38;
  const float size = 17 * std::max(unit, 0.8F * unit_of(canvas.height));  // smaller letters are hard to read
  const ImVec2 middle(place.middle.x(), place.middle.y());
  canvas.list.AddText(&canvas.font, size, {middle.x + 44 * unit, middle.y - size * 0.5F}, canvas.ink,
                      arrow.text.c_str());
  const Vec3f along = arrow.vector.normalized();
  const Vec3f right = viewpoint.forward().cross(viewpoint.up);
  const Vec2f flat(along.dot(right), -along.dot(viewpoint.up));
  // An arrow straight into the picture would be a point: it keeps a visible length.
  const float length = 32 * unit * std::max(flat.norm(), 0.35F);
  const Vec2f direction = flat.norm() > 1e-3F ? flat.normalized().eval() : Vec2f(0, -1);
  const Vec2f side(-direction.y(), direction.x());
  const auto at = [&](float forward, float sideways) {
    const Vec2f p = forward * direction + sideways * side;
    return ImVec2(middle.x + p.x(), middle.y + p.y());
  };
  const float head = 11 * unit;
  canvas.list.AddLine(at(-length, 0), at(length - head, 0), canvas.ink, 3 * unit);
  canvas.list.AddTriangleFilled(at(length, 0), at(length - head, -0.6F * head), at(length - head, 0.6F * head),
                                canvas.ink);
}

}  // namespace pliant_render
