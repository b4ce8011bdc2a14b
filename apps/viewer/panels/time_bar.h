#pragma once
// The bar below a run that is played.
#include "render/gl_objects.h"
#include "viewer/panels/panel_style.h"
#include "viewer/playback.h"

namespace pliant_viewer {

using pliant_render::Vec2f;

/// At the lower edge of a picture of this size; whoever drags its handle chooses the frame.
void draw_time_bar(Playback& playback, const Vec2f& picture, const PanelStyle& style);

}  // namespace pliant_viewer
