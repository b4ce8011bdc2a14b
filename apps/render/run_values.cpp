#include "render/run_values.h"

#include <algorithm>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "render/scalar_fields.h"

namespace pliant_render {
namespace {

using pliant::Positions;
using pliant::Real;

/// Of a step, and of the time between two frames.
constexpr Real time_rounding = 1e-6;

const pliant::Body& body_of_scene(const pliant::Simulation& simulation, const pliant::Body& body) {
  const auto& bodies = simulation.bodies();
  const auto found = std::ranges::find(bodies, body.name, &pliant::Body::name);
  if (found != bodies.end() && found->mesh.vertex_count() == body.mesh.vertex_count()) return *found;
  pliant::fail_input(fmt::format("the scene has no body '{}' of {} vertices", body.name, body.mesh.vertex_count()));
}

}  // namespace

void take_tetrahedra(pliant::Animation& animation, const pliant::Simulation& simulation) {
  for (pliant::Body& body : animation.bodies) {
    const pliant::Mesh& mesh = body_of_scene(simulation, body).mesh;
    if (mesh.tetrahedra.empty()) continue;
    body.mesh.tetrahedra = mesh.tetrahedra;
    body.mesh.triangles = mesh.triangles;
    body.mesh.faces = mesh.faces;
  }
}

RunValues::RunValues(const pliant::Animation& animation, std::optional<pliant::Scene> scene)
    : animation_(animation), scene_(std::move(scene)), render_mesh_(make_render_mesh(animation.bodies)) {
  Positions first;
  animation_.cache.frame(0, first);
  rest_at(render_mesh_, first);
  if (scene_) first_vertex_ = body_of_scene(scene_->simulation, animation_.bodies.front()).first_vertex;
}

std::vector<pliant::VertexValues> RunValues::at(std::size_t frame) {
  const Real time = animation_.times[frame];
  Positions positions;
  animation_.cache.sample(time, positions);
  std::vector<pliant::VertexValues> values;
  values.push_back({"velocity", 3, velocities(time, positions)});
  values.push_back({"stretch", 1, vertex_stretch(render_mesh_, to_floats(positions))});
  if (scene_) values.push_back({"energy", 1, energies(time)});
  return values;
}

std::vector<float> RunValues::velocities(Real time, const Positions& positions) const {
  const pliant::PointCache& cache = animation_.cache;
  std::vector<float> numbers(static_cast<std::size_t>(positions.size()), 0);
  std::int64_t before = cache.frame_count() - 1;
  while (before > 0 && cache.time(before) > time - time_rounding * (cache.time(before) - cache.time(before - 1))) {
    --before;
  }
  const Real duration = time - cache.time(before);
  if (!(duration > 0)) return numbers;
  Positions earlier;
  cache.frame(before, earlier);
  const Positions velocities = (positions - earlier) / duration;
  std::ranges::transform(std::span(velocities.data(), numbers.size()), numbers.begin(),
                         [](Real number) { return static_cast<float>(number); });
  return numbers;
}

/// The bodies of the scene that the animation has not stay where they start.
void RunValues::place_bodies(Real time) {
  pliant::State state = scene_->simulation.state();
  state.step = clock_.step;
  state.time = clock_.time;
  Positions positions;
  animation_.cache.sample(time, positions);
  state.positions.middleRows(first_vertex_, positions.rows()) = positions;
  scene_->simulation.restore(state);
}

/// Normals that constraints take at the start of a step and keep in it.
void RunValues::freeze_shapes() {
  const pliant::Simulation& simulation = scene_->simulation;
  const pliant::StateView view = simulation.state().view();
  for (const auto& [id, group] : simulation.groups()) {
    for (const auto& batch : group.set.batches) {
      if (batch->freezes_shape()) batch->begin_step(view, simulation.settings().time_step);
    }
  }
}

std::vector<float> RunValues::energies(Real time) {
  const Real step = scene_->simulation.settings().time_step;
  while (clock_.time < time - time_rounding * step) {
    place_bodies(clock_.time);
    scene_->timeline.act_due(scene_->simulation, clock_.step, clock_.time);
    scene_->timeline.move_all(scene_->simulation);
    freeze_shapes();
    clock_.advance_time(scene_->simulation.settings().time_step);
  }
  place_bodies(time);
  if (clock_.step > 0 && scene_->simulation.settings().energy_projection > 0) freeze_shapes();  // as its steps end
  const std::vector<float> all = vertex_energy(scene_->simulation);
  const auto first = all.begin() + first_vertex_;
  return {first, first + animation_.cache.vertex_count()};
}

}  // namespace pliant_render
