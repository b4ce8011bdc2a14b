#pragma once
// What all that is drawn on top of the picture shares.
#include <imgui.h>

#include "render/vectors.h"

namespace pliant_viewer {

constexpr ImU32 ink = IM_COL32(40, 44, 52, 255);
constexpr ImU32 halo = IM_COL32(255, 255, 255, 170);
constexpr ImU32 amber = IM_COL32(255, 178, 31, 255);  // of what is selected, or under the mouse

inline ImVec2 to_imgui(const pliant_render::Vec2f& p) {
  return {p.x(), p.y()};
}

}  // namespace pliant_viewer
