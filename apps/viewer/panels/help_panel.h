#pragma once
// All keys and buttons, over everything.
#include "render/gl_objects.h"
#include "viewer/panels/panel_style.h"

namespace pliant_viewer {

using pliant_render::Vec2f;

/// In the middle of a picture of this size; `is_live`: pulling and pins are possible. Returns false when it was closed.
bool draw_help(bool is_live, const Vec2f& picture, const PanelStyle& style);

}  // namespace pliant_viewer
