#pragma once
// Annotations on top of a picture, drawn by ImGui: the legend of the colors and the wind.
#include <optional>
#include <string>
#include <vector>

#include "pliant_io/scene/view_settings.h"
#include "render/camera.h"

struct ImFont;
struct ImDrawList;

namespace pliant_render {

struct Legend {
  std::string title;                                ///< above the bar: "speed [m/s]"
  std::array<float, 2> range = {0, 1};              ///< values at the ends of the bar
  float factor = 1;                                 ///< applied to the numbers shown: 100 for percent
  std::vector<std::array<std::uint8_t, 3>> colors;  ///< RGB (sRGB) from the lowest value to the highest
};

struct WindAnnotation {
  Vec3f velocity = {0, 0, 0};  ///< direction of the arrow [m/s, or N/m² for a wind given as pressure]
  std::string text;            ///< "wind 5 m/s"
};

/// Width of a legend at the right edge of a picture of this height [pixels].
float legend_width(int height);

/// The legend for a picture of this size [pixels]; none if nothing is colored, none is wanted, or it would leave too
/// little room for the picture.
std::optional<Legend> make_legend(const pliant::ViewSettings& appearance, const std::array<float, 2>& range, int width,
                                  int height);

/// Ticks of a scale: three to six round numbers in the range, ascending.
std::vector<float> round_ticks(float low, float high);
/// The label of a tick, with the decimals of `step` and no more; with three significant digits where that is too long.
std::string tick_text(float tick, float step);

/// The color of text as ImGui packs it: dark on light backgrounds, light on dark ones.
std::uint32_t ink_on(const pliant::Color& background);

enum class Letters { latin, with_symbols };
/// Loads the font into the current context of ImGui, for letters of this height [pixels].
ImFont* load_font(float pixels, Letters letters = Letters::latin);

/// Where annotations are drawn, and with what.
struct AnnotationCanvas {
  ImDrawList& list;   ///< receives the shapes
  ImFont& font;       ///< of all text
  std::uint32_t ink;  ///< of text and lines, see ink_on()
  float width;        ///< of the picture, in pixels
  float height;       ///< of the picture, in pixels
};
void draw_legend(const Legend& legend, const AnnotationCanvas& canvas);
/// Where the arrow of the wind has its middle in a picture of this height, and how far its tip may be from there.
Vec2f wind_arrow_place(float height);
float wind_arrow_radius(float height);
void draw_wind(const WindAnnotation& wind, const Viewpoint& viewpoint, const AnnotationCanvas& canvas);

/// A direction and what is written beside it.
struct ArrowAnnotation {
  Vec3f vector = {0, 0, 0};  ///< of any length but zero
  std::string text;
};
/// Where it is drawn.
struct ArrowPlace {
  Vec2f middle;
  float radius;  ///< the tip may be almost as far from there
};
void draw_arrow(const ArrowAnnotation& arrow, const ArrowPlace& place, const Viewpoint& viewpoint,
                const AnnotationCanvas& canvas);

}  // namespace pliant_render
