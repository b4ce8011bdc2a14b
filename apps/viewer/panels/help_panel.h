#pragma once
// All keys and buttons, over everything.
#include "viewer/panels/panel_style.h"

namespace pliant_viewer {

/// `is_live`: pulling and pins are possible. Returns false when it was closed.
bool draw_help(bool is_live, float width, float height, const PanelStyle& style);

}  // namespace pliant_viewer
