#pragma once
// The help: all keys and mouse buttons, on top of everything.
#include "render/gl_objects.h"
#include "viewer/panels/panel_style.h"

namespace pliant_viewer {

using pliant_render::Vec2f;

/// Draws the help in the middle of a picture of this size; `is_live`: bodies can be pulled and pinned. Returns false
/// when the user closed it.
bool draw_help(bool is_live, const Vec2f& picture, const PanelStyle& style);

}  // namespace pliant_viewer
