#include "viewer/handles.h"

namespace pliant_viewer {
namespace {

using Part = TransformGizmo::Part;
using View = MouseInteraction::View;

}  // namespace

bool Handles::handle(const MouseEvent& event, const View& view) {
  // What is busy comes first: another handle may lie on the way of the mouse.
  if (pins.is_busy()) return pins.handle(event, view);
  if (collider.is_busy()) return collider.handle(event, view);
  if (forces.is_busy()) return forces.handle(event, view);
  return pins.handle(event, view) || collider.handle(event, view) || forces.handle(event, view);
}

void Handles::flush(const View& view) {
  pins.flush(view);
  collider.flush(view);
}

void Handles::cancel() {
  const std::string selected = collider.selected();
  *this = Handles();
  collider.select(selected);
}

void Handles::take_click(const MouseInteraction::Click& click, const Snapshot& snapshot) {
  const auto found =
      click.collider ? snapshot.movable.find(pliant::ColliderId{*click.collider}) : snapshot.movable.end();
  const std::string name = found == snapshot.movable.end() ? "" : found->second.name;
  collider.select(name == collider.selected() ? "" : name);
}

bool Handles::draw(const View& view, const std::optional<Vec2f>& mouse,
                   const pliant_render::AnnotationCanvas& canvas) const {
  const Part of_pins = mouse ? pins.part_at(*mouse, view) : Part::none;
  const Part of_collider = mouse && of_pins == Part::none ? collider.part_at(*mouse, view) : Part::none;
  const bool is_free = mouse && of_pins == Part::none && of_collider == Part::none;
  const auto arrow = is_free ? ForceArrows::at(*mouse, view) : std::nullopt;
  forces.draw(view, arrow, canvas);
  collider.draw(view, of_collider, canvas.list);
  pins.draw(view, of_pins, canvas.list);
  return arrow || of_pins != Part::none || of_collider != Part::none;
}

}  // namespace pliant_viewer
