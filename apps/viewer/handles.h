#pragma once
// All handles in the picture: of selected pins, of a collider, of forces.
#include "viewer/collider_gizmo.h"
#include "viewer/force_arrows.h"
#include "viewer/pin_gizmo.h"

namespace pliant_viewer {

struct Handles {
  PinGizmo pins;
  ColliderGizmo collider;
  ForceArrows forces;

  /// Takes an event on one of them, and what follows until the release; false: the event is not meant for them.
  bool handle(const MouseEvent& event, const MouseInteraction::View& view);
  void flush(const MouseInteraction::View& view);
  bool is_busy() const { return pins.is_busy() || collider.is_busy() || forces.is_busy(); }
  void cancel();
  /// Selects what a click was on: a collider, once more or nothing: none.
  void take_click(const MouseInteraction::Click& click, const Snapshot& snapshot);
  /// Draws them; `mouse`: where it is, if it is free to take one. Returns whether it would.
  bool draw(const MouseInteraction::View& view, const std::optional<Vec2f>& mouse,
            const pliant_render::AnnotationCanvas& canvas) const;
};

}  // namespace pliant_viewer
