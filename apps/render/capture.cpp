#include "render/capture.h"

#include <algorithm>

#include <fmt/format.h>

#include "pliant/forces/test_force.h"
#include "pliant/forces/wind.h"
#include "pliant/simulation/held.h"
#include "render/scalar_fields.h"

namespace pliant_render {
namespace {

using pliant::ColorBy;

void sort_and_trim(std::vector<std::uint32_t>& list) {
  std::ranges::sort(list);
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

void append(std::vector<std::uint32_t>& list, std::span<const Index> vertices) {
  for (const Index vertex : vertices) list.push_back(static_cast<std::uint32_t>(vertex));
}

std::vector<float> find_values(const pliant::Simulation& simulation, const RenderMesh& render_mesh,
                               std::span<const Vec3f> positions, ColorBy color) {
  switch (color) {
    case ColorBy::stretch:
      return vertex_stretch(render_mesh, positions);
    case ColorBy::energy:
      return vertex_energy(simulation);
    case ColorBy::speed:
      return vertex_speed(simulation.state().velocities);
    case ColorBy::gap:
      return vertex_gap(simulation);
    case ColorBy::contact_force:
      return vertex_contact_force(simulation);
    case ColorBy::none:
      break;
  }
  return {};
}

/// Of bodies that are held as a whole, figures say, markers would hide the surface.
std::vector<std::uint32_t> find_pins(const pliant::Simulation& simulation) {
  const std::vector<char> held = held_vertices(simulation);
  std::vector<std::uint32_t> pinned;
  for (const auto& [id, group] : simulation.groups()) {
    if (group.type != "position" || is_held(simulation.body(group.body), held)) continue;
    append(pinned, vertices_of_pins(group));
  }
  sort_and_trim(pinned);
  return pinned;
}

}  // namespace

std::vector<std::uint32_t> find_markers(const pliant::Simulation& simulation, std::int64_t step) {
  std::vector<std::uint32_t> markers = find_pins(simulation);
  for (const auto& [id, force] : simulation.forces()) {
    const auto* test = simulation.options<pliant::TestForce>(id);
    if (test == nullptr || !test->is_active(step)) continue;
    append(markers, pliant::selected_vertices(force->type(), simulation.scope(id), test->vertices));
  }
  sort_and_trim(markers);
  return markers;
}

std::vector<std::uint32_t> find_held(const pliant::Simulation& simulation) {
  const std::vector<char> held = held_vertices(simulation);
  std::vector<std::uint32_t> found;
  for (const pliant::Body& body : simulation.bodies()) {
    if (!is_held(body, held)) continue;
    const pliant::Index end = body.first_vertex + body.mesh.vertex_count();
    for (pliant::Index v = body.first_vertex; v < end; ++v) found.push_back(static_cast<std::uint32_t>(v));
  }
  return found;
}

std::optional<WindAnnotation> find_wind(const pliant::Simulation& simulation) {
  for (const auto& [id, force] : simulation.forces()) {
    const auto* wind = simulation.options<pliant::Wind>(id);
    if (wind == nullptr) continue;
    const Vec3f velocity = wind->velocity.cast<float>();
    if (!(velocity.norm() > 0)) continue;
    const bool is_relative = wind->model == pliant::WindModel::relative;
    return WindAnnotation{velocity, fmt::format("wind {:.3g} {}", velocity.norm(), is_relative ? "m/s" : "N/m²")};
  }
  return {};
}

RenderMesh make_render_mesh(const pliant::Simulation& simulation) {
  return make_render_mesh(simulation.bodies(), find_held(simulation));
}

RenderMesh make_render_mesh(const pliant::Scene& scene) {
  RenderMesh render_mesh = make_render_mesh(scene.simulation);
  render_mesh.looks =
      body_looks(scene.simulation.bodies(), scene.appearances, scene.materials, scene.collider_appearances);
  return render_mesh;
}

ClipFrame capture_frame(const pliant::Simulation& simulation, const RenderMesh& render_mesh, ColorBy color,
                        ColliderSurfaces& surfaces) {
  ClipFrame frame;
  frame.time = simulation.state().time;
  frame.content.positions = to_floats(simulation.state().positions);
  frame.content.values = find_values(simulation, render_mesh, frame.content.positions, color);
  frame.content.markers = find_markers(simulation, simulation.state().step);
  frame.content.colliders = surfaces.find(simulation);
  frame.content.held = find_held(simulation);
  frame.wind = find_wind(simulation);
  return frame;
}

ClipFrame capture_frame(const pliant::Simulation& simulation, const RenderMesh& render_mesh, ColorBy color) {
  ColliderSurfaces surfaces;
  return capture_frame(simulation, render_mesh, color, surfaces);
}

}  // namespace pliant_render
