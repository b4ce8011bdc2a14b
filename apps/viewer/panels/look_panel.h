#pragma once
// How the picture is drawn.
#include "pliant_io/scene/view_settings.h"
#include "viewer/panels/panel_style.h"
#include "viewer/stage.h"

namespace pliant_viewer {

/// Draws a row for each setting of the look; `samples`: of a pixel, 1 or 4. Returns whether colors tell another
/// quantity now.
bool draw_look_panel(pliant::ViewSettings& look, int& samples, const Stage& stage);

}  // namespace pliant_viewer
