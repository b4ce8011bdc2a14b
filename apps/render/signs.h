#pragma once
// What lies flat on a picture, to be drawn onto a list of ImGui: the legend of the colors, and the wind.
#include <optional>
#include <string>
#include <vector>

#include "pliant_io/scene/view_settings.h"
#include "render/camera.h"

struct ImFont;
struct ImDrawList;

namespace pliant_render {

struct Legend {
  std::string title;
  std::array<float, 2> range = {0, 1};
  float factor = 1;  ///< of the numbers that are shown: 100 for percent
  std::vector<std::array<std::uint8_t, 3>> colors;
};

struct WindSign {
  Vec3f velocity = {0, 0, 0};
  std::string text;  ///< "wind 5 m/s"
};

/// Pixels that a legend takes at the right edge of a picture.
float legend_width(int height);

/// The legend of what the colors of a picture of this size tell; none where they tell nothing, where none is wanted,
/// and where it would leave no room for anything else.
std::optional<Legend> make_legend(const pliant::ViewSettings& look, const std::array<float, 2>& range, int width,
                                  int height);

/// Numbers for the ticks of a scale: three to six round ones in the range, ascending.
std::vector<float> round_ticks(float low, float high);
/// A tick that is a multiple of `step`, with all digits of that and no more; with three where these would be many.
std::string tick_text(float tick, float step);

/// Dark on light backgrounds, light on dark ones, as ImGui has colors.
std::uint32_t ink_on(const pliant::Color& background);

enum class Letters { latin, with_symbols };
/// Loads the font of everything that is written into the current context of ImGui, for letters of this height [pixels].
ImFont* load_font(float pixels, Letters letters = Letters::latin);

/// Where signs are drawn, and what with.
struct SignSheet {
  ImDrawList& list;
  ImFont& font;
  std::uint32_t ink;
  float width;   ///< of the picture, in pixels
  float height;  ///< of the picture, in pixels
};
void draw_legend(const Legend& legend, const SignSheet& sheet);
void draw_wind(const WindSign& wind, const Viewpoint& viewpoint, const SignSheet& sheet);

}  // namespace pliant_render
