#include "web_scene.h"

#include <algorithm>
#include <cmath>

#include "pliant_io/scene/mesh_scene.h"
#include "render/choose_direction.h"
#include "render/scalar_fields.h"

namespace pliant_web {
namespace {

using pliant_render::Bounds;
using pliant_render::RenderMesh;

using Bytes = std::array<std::uint8_t, 4>;

Bytes bytes(const pliant::Color& color, std::uint8_t fourth) {
  const auto byte = [](Real share) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp<Real>(share, 0, 1)));
  };
  return {byte(color.red), byte(color.green), byte(color.blue), fourth};
}

/// The tones that a scene gives are those of all bodies; without them each has tones of its own.
pliant::BodyTones tones_of(const pliant::ViewSettings& view, std::uint8_t number) {
  const bool is_given = view.front || view.back;
  const pliant::BodyTones& tones = is_given ? pliant::body_tones.front() : pliant::body_tones.at(number);
  return {view.front.value_or(tones.front), view.back.value_or(tones.back)};
}

/// Around the first frame, with room for motion.
Bounds bounds_with_room(const pliant_render::FrameContent& frame, const pliant::ViewSettings& view) {
  Bounds bounds = bounds_of(frame, view);
  if (bounds.is_empty()) bounds.add(Vec3f::Zero());
  const Vec3f room = Vec3f::Constant(0.12F * bounds.radius());
  bounds.add(bounds.low - room);
  bounds.add(bounds.high + room);
  return bounds;
}

/// The colors of every vertex, then of the copies.
void color(Look& look, const pliant::ViewSettings& view, const std::vector<std::uint32_t>& held) {
  const RenderMesh& mesh = look.mesh;
  const auto& gray = pliant_render::solid_tone;
  const pliant::Color solid{gray.x(), gray.y(), gray.z()};
  for (std::uint32_t v = 0; v < static_cast<std::uint32_t>(mesh.vertex_count); ++v) {
    const auto sheet = static_cast<std::uint8_t>(mesh.is_sheet[v] != 0 ? 255 : 0);
    const bool is_held = std::ranges::binary_search(held, v);
    const pliant::BodyTones tones = is_held ? pliant::BodyTones{solid, solid} : tones_of(view, mesh.tones[v]);
    look.front.push_back(bytes(tones.front, sheet));
    look.back.push_back(bytes(tones.back, 0));
    look.second.emplace_back();
    look.places.emplace_back(Vec3f::Zero());
    if (mesh.looks.vertices.empty() || mesh.looks.vertices[v].front[3] == 0) continue;
    const pliant_render::VertexLook& own = mesh.looks.vertices[v];
    look.front.back() = {own.front[0], own.front[1], own.front[2], sheet};
    look.back.back() = own.back;
    if (own.back[3] >= pliant_render::texture_pattern) look.back.back()[3] = 0;  // the page draws no textures
    look.second.back() = own.second;
    look.places.back() = own.place;
  }
  for (const std::uint32_t vertex : mesh.copies) {
    look.front.push_back(Bytes(look.front[vertex]));
    look.back.push_back(Bytes(look.back[vertex]));
    look.second.push_back(Bytes(look.second[vertex]));
    look.places.push_back(Vec3f(look.places[vertex]));
  }
}

}  // namespace

WebScene::WebScene(pliant_viewer::MakeScene make, std::string folder)
    : folder_(std::move(folder)), session_(std::move(make)), view_(session_.scene().view) {}

WebScene WebScene::of_text(const std::string& text, const std::string& name, const std::string& folder) {
  return WebScene([=] { return pliant::parse_scene(text, folder, name); }, folder);
}

WebScene WebScene::of_mesh(const std::string& file, const pliant::ImportOptions& import) {
  return WebScene([=] { return pliant::make_mesh_scene(file, import); },
                  std::filesystem::path(file).parent_path().string());
}

Look WebScene::look(float aspect) {
  Look look;
  look.mesh = pliant_render::make_render_mesh(session_.scene());
  const pliant_render::FrameContent frame = visible_part(
      pliant_render::capture_frame(session_.simulation(), look.mesh, pliant::ColorBy::none).content, view_);
  color(look, view_, frame.held);
  const Bounds bounds = bounds_with_room(frame, view_);
  const pliant::Camera camera = choose_direction(view_.camera, look.mesh, std::span(&frame, 1), bounds, aspect);
  camera_path_.emplace(camera, bounds, aspect);
  look.viewpoint = camera_path_->at(session_.simulation().state().time);
  look.radius = bounds.radius();
  return look;
}

/// Without a height of the scene's own the ground lies a little below everything, and gives way to what falls.
Frame WebScene::frame(const RenderMesh& mesh) {
  Frame frame;
  const pliant::Simulation& simulation = session_.simulation();
  frame.positions = pliant_render::to_floats(simulation.state().positions);
  frame.normals = corner_normals(mesh, frame.positions);
  if (view_.colliders) frame.colliders = surfaces_.find(simulation);
  for (const pliant_viewer::PinnedVertex& pin : session_.pinned_vertices()) frame.pins.push_back(pin.vertex);
  const Bounds bounds = pliant_render::bounds_of(
      {.positions = frame.positions, .values = {}, .markers = {}, .colliders = frame.colliders});
  if (!bounds.is_empty()) {
    const float below = bounds.low.z() - 0.03F * bounds.radius();
    ground_ = ground_ ? std::min(*ground_, below) : bounds.low.z() - 0.10F * bounds.radius();
  }
  frame.ground = view_.ground_height ? static_cast<float>(*view_.ground_height) : ground_.value_or(0);
  for (const std::uint32_t vertex : mesh.copies) frame.positions.push_back(Vec3f(frame.positions[vertex]));
  if (camera_path_ && !view_.camera.keyframes.empty()) frame.viewpoint = camera_path_->at(simulation.state().time);
  return frame;
}

Values WebScene::values(const RenderMesh& mesh, pliant::ColorBy color) {
  Values result;
  result.values = pliant_render::capture_frame(session_.simulation(), mesh, color, surfaces_).content.values;
  const float largest = pliant_render::field_range(color, result.values)[1];
  result.range = range_.update(color, largest, pliant_viewer::Clock::now());
  for (const std::uint32_t vertex : mesh.copies) result.values.push_back(float(result.values[vertex]));
  return result;
}

void WebScene::restart(bool keep_changes) {
  session_.restart(keep_changes);
  view_ = session_.scene().view;
  ground_.reset();
}

std::string WebScene::text() const {
  return session_.text(std::filesystem::path(folder_) / "scene.json", view_);
}

}  // namespace pliant_web
