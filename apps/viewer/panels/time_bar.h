#pragma once
// The bar below a run that is played.
#include "viewer/panels/panel_style.h"
#include "viewer/playback.h"

namespace pliant_viewer {

/// Between these edges of the window [pixels]; whoever drags its handle chooses the frame.
void draw_time_bar(Playback& playback, float left, float right, float bottom, const PanelStyle& style);

}  // namespace pliant_viewer
