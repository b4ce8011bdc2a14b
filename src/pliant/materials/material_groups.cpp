#include "pliant/materials/material_groups.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "pliant/core/printable.h"
#include "pliant/mesh/topology.h"

namespace pliant {
namespace {

/// A Poisson's ratio is expressed where warp and weft agree so far.
constexpr Real alike = 1.001;
constexpr Real gravity = 9.81;  // [m/s²]
/// Threads that were made softer are taut from so much on where they have no slack, or so many times `least_stretch`,
/// with the modulus that was measured, or so many times their own.
constexpr Real least_taut = 0.005;
constexpr Real taut_beyond = 5;
constexpr Real most_taut = 5;
/// Of the stiffness of slack threads, what they have at rest.
constexpr Real slack_share = 0.005;

/// The modulus with which a meter that hangs is stretched by `stretch` at its top; `density` a square or a cubic meter.
Real modulus_of(Real stretch, Real density) {
  return stretch > 0 ? density * gravity / stretch : std::numeric_limits<Real>::max();
}

std::vector<MaterialGroup> sheet_groups(SheetMaterial sheet, const MaterialPlacement& placement) {
  std::vector<MaterialGroup> groups;
  const Real most = modulus_of(placement.least_stretch, sheet.area_density);
  const Real measured_warp = sheet.stretch_warp, measured_weft = sheet.stretch_weft;
  sheet.stretch_warp = std::min(sheet.stretch_warp, most);
  sheet.stretch_weft = std::min(sheet.stretch_weft, most);
  const Real softer = std::min(sheet.stretch_warp, sheet.stretch_weft);
  const Real stiffer = std::max(sheet.stretch_warp, sheet.stretch_weft);
  const bool is_plate = sheet.poisson > 0 && stiffer <= alike * softer;
  const Real strain = is_plate ? softer / (1 + sheet.poisson) : std::min(2 * sheet.shear, softer);
  const Real taut_stretch = 1 + std::max(least_taut, taut_beyond * placement.least_stretch);
  const auto add_fibres = [&](std::string_view name, Real stretch, Real measured, Real angle) {
    if (!(stretch > alike * strain)) return;
    FibreStrain fibres{.direction = placement.direction,
                       .grain = placement.grain,
                       .angle = placement.angle + angle,
                       .stiffness = stretch - strain,
                       .taut_factor = std::min((measured - strain) / (stretch - strain), most_taut),
                       .taut_stretch = taut_stretch};
    if (placement.slack > 0) {
      fibres.min_stretch = 0;
      fibres.slack_factor = slack_share;
      fibres.taut_onset = 1;
      fibres.taut_stretch = 1 + std::max(2 * placement.slack, taut_beyond * placement.least_stretch);
    }
    groups.push_back({name, std::move(fibres)});
  };
  if (!is_plate) {
    add_fibres("warp", sheet.stretch_warp, measured_warp, 0);
    add_fibres("weft", sheet.stretch_weft, measured_weft, 90);
  }
  groups.push_back({is_plate ? "stretch" : "shear", TriangleStrain{.stiffness = strain}});
  if (is_plate) {
    const Real nu = sheet.poisson;
    groups.push_back({"width", TriangleArea{.stiffness = 2 * softer * nu / (1 - nu * nu)}});
  }
  groups.push_back({"bend", TriangleBending{.stiffness = sheet.bending, .orientation = Orientation::signed_}});
  return groups;
}

std::vector<MaterialGroup> solid_groups(const SolidMaterial& solid, const MaterialPlacement& placement) {
  const Real nu = solid.poisson;
  const Real strain = std::min(solid.young_modulus, modulus_of(placement.least_stretch, solid.density)) / (1 + nu);
  std::vector<MaterialGroup> groups = {{"solid", TetrahedronStrain{.stiffness = strain}}};
  if (nu > 0) groups.push_back({"volume", TetrahedronVolume{.stiffness = 3 * strain * nu / (1 - 2 * nu)}});
  return groups;
}

}  // namespace

std::vector<MaterialGroup> material_groups(const Material& material, const MaterialPlacement& placement) {
  if (const auto* sheet = std::get_if<SheetMaterial>(&material.of)) return sheet_groups(*sheet, placement);
  return solid_groups(std::get<SolidMaterial>(material.of), placement);
}

Mass mass_of(const Material& material) {
  if (const auto* sheet = std::get_if<SheetMaterial>(&material.of)) return Mass::area_density(sheet->area_density);
  return Mass::density(std::get<SolidMaterial>(material.of).density);
}

std::string misfit(const Material& material, const Mesh& mesh) {
  const std::string name = printable(material.name);
  if (material.is_sheet() && mesh.triangles.empty()) {
    return fmt::format("'{}' is a sheet, and the mesh has no triangles; give {}", name,
                       mesh.tetrahedra.empty() ? "constraints by themselves" : "a solid, such as 'foam'");
  }
  if (!material.is_sheet() && mesh.tetrahedra.empty()) {
    return fmt::format("'{}' is a solid, and the mesh has no tetrahedra; give a sheet, such as 'cotton'", name);
  }
  return "";
}

Real fold_length(const SheetMaterial& sheet) {
  return std::cbrt(sheet.bending / (sheet.area_density * gravity));
}

std::string coarseness(const Material& material, const Mesh& mesh) {
  const auto* sheet = std::get_if<SheetMaterial>(&material.of);
  if (sheet == nullptr || mesh.triangles.empty()) return "";
  std::vector<Real> lengths;
  for (const Edge& edge : edge_triangles(mesh).edges) {
    lengths.push_back((mesh.vertices.row(edge[0]) - mesh.vertices.row(edge[1])).norm());
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::ranges::nth_element(lengths, middle);
  const Real longest = 2 * fold_length(*sheet);
  if (!(*middle > longest)) return "";
  return fmt::format(
      "edges are {:.2g} cm long, and '{}' needs them below {:.2g} cm to fold; with these it shows dimples of their "
      "size; give a finer mesh, or more `bending`",
      100 * *middle, printable(material.name), 100 * longest);
}

void check_material(const Body& body, const Material& material) {
  if (const std::string reason = misfit(material, body.mesh); !reason.empty()) {
    fail_input(fmt::format("body '{}': {}", printable(body.name), reason));
  }
  const std::string name_of_material = fmt::format("material '{}'", printable(material.name));
  std::visit([&](const auto& of) { check_options(name_of_material, of); }, material.of);
  check_options(name_of_material, material.surface);
}

std::vector<GroupId> add_material(Simulation& simulation, BodyId id, const Material& material,
                                  const MaterialPlacement& placement) {
  check_material(simulation.body(id), material);
  const std::string body = simulation.body(id).name;
  std::vector<GroupId> ids;
  for (const MaterialGroup& group : material_groups(material, placement)) {
    const std::string name = fmt::format("{}.{}", body, group.name);
    ids.push_back(std::visit([&](const auto& options) { return simulation.add(id, options, name); }, group.options));
  }
  BodyContact contact = simulation.body(id).contact;
  if (!contact.friction) {
    contact.friction = material.surface.friction;
    simulation.set_contact(id, contact);
  }
  return ids;
}

std::optional<Real> mean_damping(const Simulation& simulation, const std::map<BodyId, Material>& materials) {
  if (materials.empty()) return std::nullopt;
  Real mass = 0, sum = 0;
  for (const auto& [id, material] : materials) {
    const Body& body = simulation.body(id);
    const auto first = simulation.state().masses.begin() + body.first_vertex;
    const Real of_body = std::accumulate(first, first + body.mesh.vertex_count(), Real{0});
    mass += of_body;
    sum += of_body * material.surface.damping;
  }
  return sum / mass;
}

SolverSettings settings_for_materials() {
  SolverSettings settings;
  settings.integrator = Integrator::bdf2;
  settings.acceleration = Acceleration::lbfgs;
  settings.iterations = 20;
  settings.start = Start::adaptive;
  return settings;
}

}  // namespace pliant
