#pragma once
// What lies flat on a picture: the legend of the colours, and the wind.
#include <optional>
#include <string>
#include <vector>

#include "pliant/scene/view_settings.h"
#include "render/camera.h"

struct ImGuiContext;
struct ImFont;
struct ImDrawList;

namespace pliant_render {

struct Legend {
  std::string title;
  std::array<float, 2> range = {0, 1};
  float factor = 1;  ///< of the numbers that are shown: 100 for percent
  std::vector<std::array<std::uint8_t, 3>> colours;
};

struct WindSign {
  Vec3f velocity = {0, 0, 0};
  std::string text;  ///< "wind 5 m/s"
};

/// Pixels that a legend takes at the right edge of a picture.
float legend_width(int height);

/// Numbers for the ticks of a scale: three to six round ones in the range, ascending.
std::vector<float> round_ticks(float low, float high);
/// A tick that is a multiple of `step`, with all digits of that and no more; with three where these would be many.
std::string tick_text(float tick, float step);

class Overlay {
 public:
  /// Loads the font. Needs a current context of OpenGL, as do all members.
  Overlay();
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  /// Draws onto the framebuffer that is bound, of this size in pixels.
  void draw(const pliant::ViewSettings& look, const Viewpoint& viewpoint, const std::optional<Legend>& legend,
            const std::optional<WindSign>& wind, int width, int height);

 private:
  void draw_legend(const Legend& legend, ImDrawList& list, float width, float height) const;
  void draw_wind(const WindSign& wind, const Viewpoint& viewpoint, ImDrawList& list, float height) const;

  ImGuiContext* context_;
  ImFont* font_ = nullptr;
  std::uint32_t ink_ = 0;
};

}  // namespace pliant_render
