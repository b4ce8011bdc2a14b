#include "viewer/body_materials.h"

#include <algorithm>
#include <cmath>

#include "pliant/materials/change_material.h"
#include "pliant/simulation/held.h"
#include "pliant/simulation/transaction.h"

namespace pliant_viewer {

using pliant::BodyId;
using pliant::Index;
using pliant::Material;

namespace {

std::vector<MaterialChoice> choices_for(const pliant::Scene& scene, const pliant::Mesh& mesh) {
  std::vector<MaterialChoice> choices;
  const auto add = [&](const Material& material) {
    const auto is_same = [&](const MaterialChoice& choice) { return choice.name == material.name; };
    if (!misfit(material, mesh).empty() || std::ranges::any_of(choices, is_same)) return;
    choices.push_back({material.name, material.description});
  };
  std::ranges::for_each(scene.own_materials, add);
  std::ranges::for_each(pliant::builtin_materials(), add);
  return choices;
}

const Material& find_material(const pliant::Scene& scene, const std::string& name) {
  const auto own = std::ranges::find(scene.own_materials, name, &Material::name);
  return own != scene.own_materials.end() ? *own : pliant::builtin_material(name);
}

bool is_nearly(std::optional<pliant::Real> damping, pliant::Real given) {
  return damping && std::abs(*damping - given) <= 1e-9 * std::abs(given);
}

}  // namespace

std::vector<BodyMaterial> list_materials(const pliant::Scene& scene, const std::vector<char>& is_figure) {
  std::vector<BodyMaterial> list;
  const pliant::Simulation& simulation = scene.simulation;
  for (Index i = 0; i < pliant::count_of(simulation.bodies()); ++i) {
    const pliant::Body& body = simulation.body(BodyId{i});
    if (is_figure.at(static_cast<std::size_t>(i)) != 0) continue;
    std::vector<MaterialChoice> choices = choices_for(scene, body.mesh);
    if (choices.empty()) continue;
    const auto found = scene.materials.find(BodyId{i});
    list.push_back(
        {BodyId{i}, body.name, found == scene.materials.end() ? "" : found->second.name, std::move(choices)});
  }
  return list;
}

void change_material(pliant::Scene& scene, BodyId body, const std::string& name,
                     const pliant::MaterialPlacement& placement) {
  const Material& material = find_material(scene, name);
  pliant::Simulation& simulation = scene.simulation;
  pliant::Transaction transaction(simulation);
  const std::optional<pliant::Real> damping_before = mean_damping(simulation, scene.materials);
  change_material(simulation, body, material, placement);
  std::map<BodyId, Material> materials = scene.materials;
  const bool is_first = materials.empty();
  materials.insert_or_assign(body, material);
  pliant::SolverSettings settings = simulation.settings();
  if (is_first) {
    const pliant::SolverSettings good = pliant::settings_for_materials();
    const auto is_explicit = [](const auto& entry) { return entry.second->is_explicit_spring(); };
    if (std::ranges::none_of(simulation.forces(), is_explicit)) settings.integrator = good.integrator;
    settings.acceleration = good.acceleration;
    settings.iterations = good.iterations;
    settings.start = good.start;
  }
  if (is_first || is_nearly(damping_before, settings.damping)) settings.damping = *mean_damping(simulation, materials);
  simulation.set_settings(settings);
  transaction.commit();
  scene.materials = std::move(materials);
}

}  // namespace pliant_viewer
