#pragma once
// The settings of the picture.
#include "pliant_io/scene/view_settings.h"
#include "viewer/panels/panel_style.h"
#include "viewer/view_source.h"

namespace pliant_viewer {

/// Draws a row for each setting; `samples` per pixel, 1 or 4. Returns whether the user chose another color field.
/// quality: the one in use, of which the settings may leave the choice to the window.
bool draw_appearance_panel(pliant::ViewSettings& appearance, int& samples, pliant::Quality quality,
                           const ViewSource& source);

}  // namespace pliant_viewer
