#include "pliant_io/scene/mesh_scene.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant/mesh/geometry.h"
#include "pliant/mesh/loose.h"
#include "pliant/mesh/topology.h"
#include "pliant_io/scene/detail/scene_files.h"

namespace pliant {
namespace {

using MeshSceneJson = nlohmann::ordered_json;

enum class MeshKind { solid, skin, cloth, ropes };

/// What a kind is made of, for a body of about a meter. Cloth is cotton; its mass and stiffness here are of ropes
/// beside.
struct MeshMaterial {
  std::string_view text;
  Real mass;       // [kg]
  Real stiffness;  // of springs and triangles [N/m], of tetrahedra [Pa]
  Real bending;    // [N·m]
};

MeshMaterial mesh_material(MeshKind kind) {
  switch (kind) {
    case MeshKind::solid:
      return {"a soft solid", 5, 2e4, 0};
    case MeshKind::skin:
      return {"a skin", 1, 2e3, 0.5};
    case MeshKind::cloth:
      return {"cloth", 0.3, 1e4, 0};
    case MeshKind::ropes:
      break;
  }
  return {"ropes", 0.3, 1e4, 0};
}

MeshKind mesh_kind(const Mesh& mesh) {
  if (!mesh.tetrahedra.empty()) return MeshKind::solid;
  if (mesh.triangles.empty()) return MeshKind::ropes;
  return boundary_edges(mesh).empty() ? MeshKind::skin : MeshKind::cloth;
}

/// The highest vertices, or the lowest: those in a band of some share of the height, and at least some share of all.
std::vector<Index> end_band(const Mesh& mesh, bool at_top, Real share_of_height, Real share_of_vertices) {
  constexpr Index least = 3;
  const Real sign = at_top ? 1 : -1;
  std::vector<Index> vertices(static_cast<std::size_t>(mesh.vertex_count()));
  std::iota(vertices.begin(), vertices.end(), Index{0});
  std::ranges::stable_sort(vertices, std::greater{}, [&](Index i) { return sign * mesh.vertices(i, 2); });
  const BoundingBox box = bounding_box(mesh.vertices);
  const Real edge = sign * mesh.vertices(vertices.front(), 2) - share_of_height * (box.max.z() - box.min.z());
  const auto in_band = static_cast<std::size_t>(
      std::ranges::count_if(vertices, [&](Index i) { return sign * mesh.vertices(i, 2) >= edge; }));
  const auto wanted = std::max<std::size_t>(
      least, static_cast<std::size_t>(share_of_vertices * static_cast<Real>(mesh.vertex_count())));
  vertices.resize(std::min(vertices.size(), std::max(in_band, wanted)));
  std::ranges::sort(vertices);
  return vertices;
}

/// The vertices nearest to the four corners of the box, seen from above.
std::vector<Index> seen_corners(const Mesh& mesh) {
  const BoundingBox box = bounding_box(mesh.vertices);
  std::vector<Index> vertices;
  for (const Real x : {box.min.x(), box.max.x()}) {
    for (const Real y : {box.min.y(), box.max.y()}) {
      Index nearest = 0;
      (mesh.vertices.leftCols(2).rowwise() - Eigen::RowVector2d(x, y)).rowwise().squaredNorm().minCoeff(&nearest);
      vertices.push_back(nearest);
    }
  }
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// The vertices that are pinned, and how that is said.
struct MeshPins {
  std::vector<Index> vertices;
  std::string_view text;
};

MeshPins mesh_pins(const Mesh& mesh, MeshKind kind) {
  if (mesh.vertex_count() == 0) return {};
  const BoundingBox box = bounding_box(mesh.vertices);
  const bool stands = kind == MeshKind::solid || kind == MeshKind::skin;
  if (stands) return {end_band(mesh, false, 0.03, 0.02), "the lowest vertices"};
  if (box.max.z() - box.min.z() < 0.02 * box.diagonal()) return {seen_corners(mesh), "the corners"};
  return {end_band(mesh, true, 0.01, 0.005), "the highest vertices"};
}

MeshSceneJson constraints_json(const Mesh& mesh, MeshKind kind, const MeshMaterial& material, const MeshPins& pins) {
  MeshSceneJson constraints = MeshSceneJson::array();
  constraints.push_back({{"type", "position"}, {"name", "pins"}, {"on", pins.vertices}});
  if (kind == MeshKind::solid) {
    constraints.push_back({{"type", "tetrahedron_strain"}, {"name", "solid"}, {"stiffness", material.stiffness}});
    return constraints;
  }
  if (kind == MeshKind::skin) {
    constraints.push_back({{"type", "triangle_strain"}, {"name", "stretch"}, {"stiffness", material.stiffness}});
    constraints.push_back(
        {{"type", "hinge"}, {"name", "bend"}, {"stiffness", material.bending}, {"orientation", "signed"}});
  }
  if (mesh.edges.empty()) return constraints;
  MeshSceneJson ropes = {{"type", "edge_spring"}, {"name", "ropes"}, {"stiffness", material.stiffness}};
  if (!mesh.triangles.empty()) ropes["stencils"] = mesh.edges;  // not those of its triangles
  constraints.push_back(std::move(ropes));
  return constraints;
}

/// Whether some vertices have only elements that a total is not shared by: those of lower dimensions.
bool has_lower_elements_alone(const Mesh& mesh) {
  Mesh highest = mesh;
  if (!mesh.tetrahedra.empty()) highest.triangles.clear();
  if (!mesh.tetrahedra.empty() || !mesh.triangles.empty()) highest.edges.clear();
  highest.faces = {};
  return loose_vertices(highest).size() > loose_vertices(mesh).size();
}

/// The total; where vertices would go without, densities that give the elements of lower dimensions a thousandth of it
/// each. `scale`: meters per unit of the mesh.
MeshSceneJson mass_json(const Mesh& mesh, const MeshMaterial& material, Real scale) {
  if (!has_lower_elements_alone(mesh)) return MeshSceneJson::object({{"total", material.mass}});
  const auto sum = [](const std::vector<Real>& measures) {
    return std::accumulate(measures.begin(), measures.end(), Real{0});
  };
  const Real length = sum(edge_lengths(mesh.vertices, mesh.edges)) * scale;
  const Real area = sum(triangle_areas(mesh.vertices, mesh.triangles)) * scale * scale;
  const Real volume = sum(tetrahedron_volumes(mesh.vertices, mesh.tetrahedra)) * scale * scale * scale;
  MeshSceneJson densities = MeshSceneJson::object();
  Real mass = material.mass;
  const auto add = [&](const char* key, Real measure) {
    if (!(measure > 0)) return;
    densities[key] = mass / measure;
    mass = 1e-3 * material.mass;
  };
  add("density", volume);
  add("area_density", area);
  add("line_density", length);
  return densities;
}

/// Meters per unit: as given, or what makes a mesh of an unlikely size a meter long.
Real likely_scale(const Mesh& mesh, const ImportOptions& import, std::string& remark) {
  constexpr Real shortest = 0.2, longest = 5;
  if (mesh.vertex_count() == 0) return import.scale;
  const BoundingBox box = bounding_box(mesh.vertices);
  const Real length = (box.max - box.min).maxCoeff();
  if (import.scale != 1 || !(length > 0) || (length >= shortest && length <= longest)) return import.scale;
  remark = fmt::format("; its {:.3g} units are taken as 1 m", length);
  return 1 / length;
}

}  // namespace

Scene make_mesh_scene(const std::filesystem::path& file, const ImportOptions& import, const SceneOverrides& overrides) {
  const Mesh mesh = read_mesh(file, import);
  std::string remark;
  const Real scale = likely_scale(mesh, import, remark);
  const MeshKind kind = mesh_kind(mesh);
  const MeshMaterial material = mesh_material(kind);
  const MeshPins pins = mesh_pins(mesh, kind);
  const std::string up(choice_names(import.up)[static_cast<std::size_t>(import.up)]);
  MeshSceneJson mesh_json = {{"file", file.filename().string()}, {"scale", scale}, {"up", up}};
  if (import.drop_loose) mesh_json["drop_loose"] = true;
  MeshSceneJson body = {{"name", file.stem().string()}, {"mesh", std::move(mesh_json)}};
  const MeshSceneJson settings = {
      {"integrator", "bdf2"}, {"iterations", 20}, {"acceleration", "lbfgs"}, {"start", "adaptive"}};
  const bool is_cloth = kind == MeshKind::cloth;
  if (is_cloth) body["material"] = "cotton";
  if (!is_cloth || has_lower_elements_alone(mesh)) body["mass"] = mass_json(mesh, material, scale / import.scale);
  body["constraints"] = constraints_json(mesh, kind, material, pins);
  const std::string description =
      fmt::format("{} of {} vertices, pinned at {}{}", material.text, mesh.vertex_count(), pins.text, remark);
  const MeshSceneJson scene = {{"pliant", 1},
                               {"description", description},
                               {"settings", settings},
                               {"bodies", MeshSceneJson::array({body})},
                               {"contact", MeshSceneJson::object()}};
  std::string text;
  try {
    text = scene.dump(2);
  } catch (const nlohmann::json::type_error&) {
    fail_input(printable_place(file.string()) + ": its name is not UTF-8, which a scene cannot hold; rename it");
  }
  return parse_scene(text, absolute_path(file).parent_path(), file.string(), overrides);
}

}  // namespace pliant
