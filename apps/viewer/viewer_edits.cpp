// What the window does with a scene as a whole: takes back, does again, saves, opens another one.
#include <algorithm>
#include <cctype>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/free_name.h"
#include "viewer/picking.h"
#include "viewer/plot_files.h"
#include "viewer/view_document.h"
#include "viewer/viewer.h"

namespace pliant_viewer {

namespace fs = std::filesystem;

namespace {

bool is_picture(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

}  // namespace

void Viewer::undo() {
  if (LiveScene* live = source_.live()) {
    brush_.finish(mouse_view());
    live->post([](CommandContext& context) {
      const std::string what = context.session.undone_next();
      context.session.undo();
      context.message = what.empty() ? "nothing to undo" : "undone: " + what;
    });
  }
}

void Viewer::redo() {
  if (LiveScene* live = source_.live()) {
    brush_.finish(mouse_view());
    live->post([](CommandContext& context) {
      const std::string what = context.session.redone_next();
      context.session.redo();
      context.message = what.empty() ? "nothing to redo" : "redone: " + what;
    });
  }
}

/// As it is shown now.
pliant::ViewSettings Viewer::placed_appearance() const {
  pliant::ViewSettings view = appearance_;
  if (!camera_.is_like(first_camera_)) view.camera = camera_.placed();
  return view;
}

void Viewer::save_scene(bool as_new) {
  LiveScene* live = source_.live();
  if (live == nullptr) return say("this is a run; its scene is in the file it was made from");
  brush_.finish(mouse_view());
  // Where nobody has moved the camera, the file leaves its place open as the scene did, unless another would be chosen.
  const bool is_open = camera_.is_like(first_camera_) && leaves_place_open(appearance_.camera);
  live->post([saved = saved_scene_, shown = placed_appearance(), placed = camera_.placed(), is_open, as_new,
              folder = picture_folder_, name = live->name(), tell = saved_](CommandContext& context) {
    pliant::ViewSettings view = shown;
    if (is_open && may_move_camera(context.session.changes())) view.camera = placed;
    const fs::path file = as_new || saved->empty() ? free_name(folder, name, {".json", ".pliant"}) : *saved;
    context.message = "saved " + saved_names(context.session.save(file, view));
    *saved = file;
    if (tell) tell(file);
  });
}

void Viewer::save_session() {
  LiveScene* live = source_.live();
  if (live == nullptr) return say("this is a run; only what is simulated here can be saved as a session");
  brush_.finish(mouse_view());
  live->post([view = placed_appearance(), folder = picture_folder_, name = live->name(),
              tell = saved_](CommandContext& context) {
    const fs::path file = free_name(folder, name, {".session"});
    const SessionRecord record = context.session.record(file, view);
    write_session_record(file, record);
    context.message = fmt::format("saved the session, {} steps and {} actions: {}", record.steps, record.actions.size(),
                                  saved_names({file}));
    if (tell) tell(file);
  });
}

/// A picture is laid on the body under the mouse, or on the only one; all else is opened.
void Viewer::take_dropped_files() {
  const std::vector<std::string> files = window_.take_dropped_files();
  if (files.empty()) return;
  if (!is_picture(files.front())) return open(files.front());
  LiveScene* live = source_.live();
  if (live == nullptr) return say("this is a run; open its scene to lay a picture on a body");
  const Snapshot& shown = live->shown();
  const auto point = pick_surface(*shown.render_mesh, shown.frame.content.positions, screen_, window_.cursor(), 0);
  if (!point && shown.body_names->size() != 1) return say("drop the picture onto the body that it is for");
  const std::string body = (*shown.body_names)[point ? shown.render_mesh->bodies[point->vertices[0]] : 0];
  const auto has_surface = [&](std::uint32_t triangle_vertex) {
    return (*shown.body_names)[shown.render_mesh->bodies[triangle_vertex]] == body;
  };
  if (std::ranges::none_of(shown.render_mesh->triangles, has_surface)) {
    return say(body + " has no surface that a picture could lie on");
  }
  pliant::BodyAppearance appearance;
  if (const auto given = shown.appearances->find(body); given != shown.appearances->end()) appearance = given->second;
  appearance.back.reset();  // on both sides
  appearance.texture = fs::absolute(files.front()).string();
  live->post([body, appearance](CommandContext& context) {
    context.session.set_appearance(body, appearance);
    context.message = fmt::format("{}: {}", body, fs::path(appearance.texture).filename().string());
  });
}

/// Says so first: a large mesh takes a while to read.
void Viewer::open(const std::string& what) {
  if (open_ == nullptr) return say("nothing else can be opened here");
  const LiveScene* live = source_.live();
  if (live != nullptr && live->shown().has_unsaved_changes && refused_ != what) {
    refused_ = what;
    return say("this scene has unsaved changes: Ctrl + S saves them; open the other one again to discard them");
  }
  waits_ = what;
  waits_turns_ = 2;
  say("opening " + fs::path(what).filename().string() + " ...");
}

void Viewer::open_what_waits() {
  if (waits_.empty() || --waits_turns_ > 0) return;
  const std::string reason = open_(std::exchange(waits_, {}));
  if (!reason.empty()) return say(reason);
  is_over_ = true;
}

/// Of the panel's last row of buttons.
void Viewer::draw_edit_buttons(float width) {
  const LiveScene* live = source_.live();
  if (live == nullptr) return;
  const Snapshot& shown = live->shown();
  const auto button = [&](const char* label, bool is_enabled, const std::string& help) {
    ImGui::BeginDisabled(!is_enabled);
    const bool is_pressed = ImGui::Button(label, {width, 0});
    ImGui::EndDisabled();
    explain(help);
    return is_pressed;
  };
  if (button("Undo", !shown.undone_next.empty(), "Ctrl + Z: undo " + shown.undone_next)) undo();
  ImGui::SameLine();
  if (button("Redo", !shown.redone_next.empty(), "Ctrl + Shift + Z: redo " + shown.redone_next)) redo();
  ImGui::SameLine();
  const std::string saving =
      shown.has_text ? "Ctrl + S: the scene with its changes and this view, and a checkpoint of this moment;\n"
                       "Ctrl + Shift + S: under a new name\n"
                       "Ctrl + R: the session, all that was done so far, to be replayed or filmed"
                     : "a program has made this scene, so it cannot be saved as a scene file";
  if (button("Save", shown.has_text, saving)) save_scene();
}

}  // namespace pliant_viewer
