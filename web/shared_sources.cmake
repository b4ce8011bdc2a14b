# The sources of the window that the page in the browser has too.
set(PLIANT_WEB_SHARED_SOURCES
  render/body_looks.cpp render/camera.cpp render/camera_path.cpp render/capture.cpp
  render/choose_direction.cpp render/collider_view.cpp render/hard_edges.cpp render/picture_places.cpp
  render/render_mesh.cpp render/scalar_fields.cpp viewer/added_parts.cpp viewer/apply_changes.cpp viewer/auto_range.cpp
  viewer/body_materials.cpp viewer/carry_over.cpp viewer/collider_entry.cpp viewer/collider_goals.cpp viewer/picking.cpp viewer/scene_changes.cpp
  viewer/rounding.cpp viewer/session.cpp viewer/session_bodies.cpp viewer/session_colliders.cpp viewer/session_edits.cpp viewer/session_log.cpp
  viewer/session_paint.cpp viewer/session_pins.cpp viewer/session_record.cpp viewer/session_replay.cpp
  viewer/sliders.cpp viewer/suggestions.cpp viewer/switched_parts.cpp viewer/view_document.cpp)
list(TRANSFORM PLIANT_WEB_SHARED_SOURCES PREPEND "${PROJECT_SOURCE_DIR}/apps/")
