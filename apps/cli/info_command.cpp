// pliant info: what a mesh is, what is wrong with it, and what that means for a simulation.
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "crossing_texts.h"
#include "import_options.h"
#include "pliant/core/printable.h"
#include "pliant/mesh/diagnosis.h"
#include "pliant_io/mesh/mesh_file.h"

namespace pliant_cli {
namespace {

using pliant::Defect;
using pliant::DefectElement;
using pliant::Diagnosis;
using pliant::FaceGroupKind;
using pliant::Index;
using Json = nlohmann::ordered_json;

struct InfoOptions {
  std::string file;              ///< a mesh
  pliant::ImportOptions import;  ///< how a mesh is read: scale and axis
  bool json = false;             ///< print one JSON object in place of the text
};

/// Where the mesh passes through itself, told like a defect.
struct SelfCrossings {
  bool is_complete = true;  ///< all were looked for
  std::int64_t count = 0;
  std::string elements;      ///< of the first one, say "triangles 17 and 402"
  pliant::Vec3 point;        ///< of the first one [m]
  std::string_view element;  ///< what has two numbers in `first`
  std::vector<std::array<Index, 2>>
      first;  ///< the first ones: two triangles each; of tetrahedra, an edge of the surface

  static constexpr pliant::DefectEffect effect = pliant::DefectEffect::harmless;
  static constexpr std::string_view meaning = "it simulates all the same; in pictures one side comes through the other";
  static constexpr std::string_view remedy = "move the two sides apart, unless meant";
};

/// Everything that is printed. The mesh itself is not kept: a diagnosis needs the memory.
struct Info {
  std::string file;
  std::string format;
  std::uintmax_t file_size = 0;
  Index group_counts[3] = {0, 0, 0};  ///< by FaceGroupKind
  Index texture_coordinate_count = 0;
  std::vector<std::string> maps;
  Diagnosis diagnosis;
  SelfCrossings self_crossings;
  pliant::Real scale = 1;  ///< that it was read with
};

/// A unit that the file may be in, by its size.
struct SuspectedUnit {
  std::string_view name;
  pliant::Real scale;  ///< to be given by --scale
  std::string text;
};

std::string size_text(const pliant::Vec3& size) {
  struct LengthUnit {
    std::string_view name;
    pliant::Real meters;
  };
  constexpr std::array units = {LengthUnit{"km", 1e3}, LengthUnit{"m", 1}, LengthUnit{"mm", 1e-3}};
  const pliant::Real longest = size.maxCoeff();
  const LengthUnit& unit = longest >= 1e3 ? units[0] : longest >= 0.1 ? units[1] : units[2];
  const pliant::Vec3 x = size / unit.meters;
  return fmt::format("{:.3g} by {:.3g} by {:.3g} {}", x[0], x[1], x[2], unit.name);
}

/// Of a mesh that is unlikely large or small, and would be of a likely size, 5 mm to 50 m, in another unit.
std::optional<SuspectedUnit> suspect_unit(const Diagnosis& d, pliant::Real scale) {
  struct LikelyUnit {
    std::string_view name;
    pliant::Real shortest, longest;  // of the mesh, as it was read [m]
    pliant::Real factor;
  };
  constexpr std::array likely_units = {LikelyUnit{"centimeters", 50, 500, 0.01},
                                       LikelyUnit{"millimeters", 500, 5e4, 0.001},
                                       LikelyUnit{"kilometers", 5e-6, 5e-3, 1000}};
  if (!d.is_measured) return {};
  const pliant::Vec3 size = d.box.max - d.box.min;
  const pliant::Real longest = size.maxCoeff();
  for (const LikelyUnit& unit : likely_units) {
    if (!(longest > unit.shortest && longest <= unit.longest)) continue;
    const pliant::Real likely_scale = scale * unit.factor;
    return SuspectedUnit{
        unit.name, likely_scale,
        fmt::format("{}: is the file in {}? then --scale {:.6g}", size_text(size), unit.name, likely_scale)};
  }
  return {};
}

SelfCrossings find_self_crossings(const pliant::Mesh& mesh) {
  const std::vector<pliant::Triangle> triangles = pliant::surface_triangles(mesh);
  SelfCrossings result;
  result.is_complete = may_be_surface(triangles.size(), mesh.vertex_count());
  if (!result.is_complete) return result;
  const pliant::Crossings found =
      pliant::find_crossings({.positions = mesh.vertices,
                              .triangles = triangles,
                              .most_effort = pliant::usual_crossing_effort(triangles.size())},
                             Defect::max_listed);
  result.is_complete = found.is_complete;
  if (found.count == 0) return result;
  const CrossingBody body{.is_solid = mesh.triangles.empty()};
  result.count = found.count;
  result.elements = both_sides_text(body, found.first[0], triangles);
  result.point = found.first[0].point;
  result.element = body.is_solid ? "edge" : "triangle";
  for (const pliant::Crossing& crossing : found.first) {
    const std::array<Index, 2> both = {crossing.edge_triangles[0], crossing.triangle};
    result.first.push_back(body.is_solid ? crossing.edge : both);
  }
  return result;
}

Info examine(const InfoOptions& options) {
  pliant::Mesh mesh = pliant::read_mesh(options.file, options.import);
  Info info;
  info.file = options.file;
  info.format = pliant::require_mesh_format(options.file).name;
  std::error_code ignored;
  info.file_size = std::filesystem::file_size(options.file, ignored);
  for (const pliant::FaceGroup& group : mesh.groups) ++info.group_counts[static_cast<std::size_t>(group.kind)];
  info.texture_coordinate_count = static_cast<Index>(mesh.texture_coordinates.rows());
  for (const pliant::VertexMap& map : mesh.maps) info.maps.push_back(pliant::printable(map.name, 40));
  mesh.maps = {};
  info.self_crossings = find_self_crossings(mesh);
  info.diagnosis = pliant::diagnose(std::move(mesh));
  info.scale = options.import.scale;
  return info;
}

// ---- as text

void print_row(std::string_view name, const std::string& value) {
  fmt::print("  {:<16} {}\n", name, value);
}

std::string plural(std::int64_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string spread_text(const pliant::Spread& spread, std::string_view unit) {
  return fmt::format("{:.4g} to {:.4g} {}, mean {:.4g}", spread.min, spread.max, unit, spread.mean);
}

void print_counts(const Info& info) {
  const Diagnosis& d = info.diagnosis;
  print_row("vertices", fmt::format("{}", d.vertex_count));
  std::string edges = fmt::format("{}", d.edge_count);
  if (d.edge_element_count > 0) edges += fmt::format(", {} of them elements of their own", d.edge_element_count);
  print_row("edges", edges);
  std::string triangles = fmt::format("{}", d.triangle_count);
  if (d.largest_polygon > 3) {
    triangles +=
        fmt::format(", from {} of up to {} corners", plural(d.polygon_count, "polygon", "polygons"), d.largest_polygon);
  }
  print_row("triangles", triangles);
  if (d.tetrahedron_count > 0) print_row("tetrahedra", fmt::format("{}", d.tetrahedron_count));
  print_row("components", fmt::format("{}", d.component_count));
  const auto& [groups, objects, materials] = info.group_counts;
  if (groups + objects + materials > 0) {
    print_row("parts", fmt::format("{}, {}, {}", plural(objects, "object", "objects"),
                                   plural(groups, "group", "groups"), plural(materials, "material", "materials")));
  }
  if (info.texture_coordinate_count > 0) print_row("texture", plural(info.texture_coordinate_count, "point", "points"));
  if (!info.maps.empty()) print_row("maps", fmt::format("{}", fmt::join(info.maps, ", ")));
}

void print_boundary(const Diagnosis& d) {
  constexpr std::size_t listed = 5;
  if (d.triangle_count == 0) return;
  if (d.boundary_loops.empty()) return print_row("boundary", "none");
  print_row("boundary", plural(static_cast<std::int64_t>(d.boundary_loops.size()), "loop", "loops"));
  for (std::size_t i = 0; i < std::min(listed, d.boundary_loops.size()); ++i) {
    const pliant::BoundaryLoop& loop = d.boundary_loops[i];
    print_row("", fmt::format("{}: {} from vertex {}, {:.4g} m", i, plural(loop.vertex_count, "vertex", "vertices"),
                              loop.first_vertex, loop.length));
  }
  if (d.boundary_loops.size() > listed) print_row("", fmt::format("and {} more", d.boundary_loops.size() - listed));
}

void print_measures(const Diagnosis& d) {
  if (!d.is_measured) return print_row("measures", "none, see far vertices below");
  const pliant::Vec3 size = d.box.max - d.box.min;
  print_row("size", fmt::format("{:.4g} x {:.4g} x {:.4g} m, from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g})",
                                size[0], size[1], size[2], d.box.min[0], d.box.min[1], d.box.min[2], d.box.max[0],
                                d.box.max[1], d.box.max[2]));
  if (d.edge_count > 0) print_row("edge length", spread_text(d.edge_length, "m"));
  if (d.triangle_count > 0) print_row("triangle area", spread_text(d.triangle_area, "m^2"));
  if (d.area > 0) print_row("area", fmt::format("{:.6g} m^2", d.area));
  if (d.volume != 0) {
    const bool points_inward = d.volume < 0 && d.tetrahedron_count == 0;
    print_row("volume", fmt::format("{:.6g} m^3{}", d.volume, points_inward ? ", the normals point inward" : ""));
  }
}

std::string element_name(DefectElement element, std::int64_t count) {
  constexpr std::array<std::array<std::string_view, 2>, 6> names{{{"vertex", "vertices"},
                                                                  {"edge", "edges"},
                                                                  {"triangle", "triangles"},
                                                                  {"tetrahedron", "tetrahedra"},
                                                                  {"polygon", "polygons"},
                                                                  {"facet", "facets"}}};
  return std::string(names[static_cast<std::size_t>(element)][count == 1 ? 0 : 1]);
}

std::string indices_text(const Defect& defect) {
  std::vector<std::string> texts;
  for (const auto& [index, other] : defect.first) {
    texts.push_back(other < 0 ? fmt::format("{}", index) : fmt::format("{}-{}", index, other));
  }
  const bool is_cut = defect.count > static_cast<std::int64_t>(texts.size());
  return fmt::format("{}{}", fmt::join(texts, ", "), is_cut ? ", ..." : "");
}

std::string_view effect_text(pliant::DefectEffect effect) {
  return choice_names(effect)[static_cast<std::size_t>(effect)];
}

void print_self_crossings(const SelfCrossings& crossings) {
  if (crossings.count == 0) return;
  fmt::print("  {:<8} crosses itself: {}{}\n", effect_text(crossings.effect), crossings.elements,
             more_text(crossings.count));
  fmt::print("           at {}\n           {}\n           remedy: {}\n", place_text(crossings.point), crossings.meaning,
             crossings.remedy);
}

void print_defects(const Diagnosis& d, const SelfCrossings& crossings) {
  if (d.defects.empty() && crossings.count == 0) {
    fmt::print("No defects.\n");
    return;
  }
  fmt::print("Defects, indices from 0:\n");
  for (const Defect& defect : d.defects) {
    const pliant::DefectInfo& kind = info_of(defect.kind);
    fmt::print("  {:<8} {}: {}\n", effect_text(kind.effect), kind.text, defect.count);
    if (!defect.first.empty()) {
      fmt::print("           {} {}\n", element_name(kind.element, defect.count), indices_text(defect));
    }
    fmt::print("           {}\n           remedy: {}\n", kind.meaning, kind.remedy);
  }
  print_self_crossings(crossings);
}

void print_text(const Info& info) {
  fmt::print("{}: {}, {} bytes\n", pliant::printable(info.file, 4096), info.format, info.file_size);
  print_counts(info);
  print_measures(info.diagnosis);
  if (const auto unit = suspect_unit(info.diagnosis, info.scale)) print_row("unit", unit->text);
  print_boundary(info.diagnosis);
  if (!info.self_crossings.is_complete) print_row("crossings", std::string(incomplete_search));
  print_defects(info.diagnosis, info.self_crossings);
}

// ---- as JSON

Json spread_json(const pliant::Spread& spread) {
  return {{"min", spread.min}, {"mean", spread.mean}, {"max", spread.max}};
}

Json defects_json(const Diagnosis& d, const SelfCrossings& crossings) {
  Json defects = Json::array();
  for (const Defect& defect : d.defects) {
    const pliant::DefectInfo& kind = info_of(defect.kind);
    Json indices = Json::array();
    for (const auto& [index, other] : defect.first) {
      indices.push_back(other < 0 ? Json(index) : Json::array({index, other}));
    }
    defects.push_back({{"kind", kind.name},
                       {"count", defect.count},
                       {"effect", effect_text(kind.effect)},
                       {"element", element_name(kind.element, 1)},
                       {"first", indices},
                       {"meaning", kind.meaning},
                       {"remedy", kind.remedy}});
  }
  if (crossings.count > 0) {
    defects.push_back({{"kind", "crossings"},
                       {"count", crossings.count},
                       {"effect", effect_text(crossings.effect)},
                       {"element", crossings.element},
                       {"first", crossings.first},
                       {"point", {crossings.point[0], crossings.point[1], crossings.point[2]}},
                       {"meaning", crossings.meaning},
                       {"remedy", crossings.remedy}});
  }
  return defects;
}

/// null where nothing is suspected.
Json unit_json(const Info& info) {
  const auto unit = suspect_unit(info.diagnosis, info.scale);
  if (!unit) return nullptr;
  return {{"unit", unit->name}, {"scale", unit->scale}, {"text", unit->text}};
}

Json boundary_json(const Diagnosis& d) {
  constexpr std::size_t most = 1000;
  Json loops = Json::array();
  for (std::size_t i = 0; i < std::min(most, d.boundary_loops.size()); ++i) {
    const pliant::BoundaryLoop& loop = d.boundary_loops[i];
    loops.push_back({{"first_vertex", loop.first_vertex}, {"vertices", loop.vertex_count}, {"length", loop.length}});
  }
  return {{"count", d.boundary_loops.size()}, {"loops", loops}};
}

void print_json(const Info& info) {
  const Diagnosis& d = info.diagnosis;
  const auto& [groups, objects, materials] = info.group_counts;
  const auto point = [](const pliant::Vec3& x) { return Json::array({x[0], x[1], x[2]}); };
  const Json json = {
      {"file", info.file},
      {"format", info.format},
      {"bytes", info.file_size},
      {"vertices", d.vertex_count},
      {"edges", d.edge_count},
      {"edge_elements", d.edge_element_count},
      {"triangles", d.triangle_count},
      {"tetrahedra", d.tetrahedron_count},
      {"polygons", d.polygon_count},
      {"largest_polygon", d.largest_polygon},
      {"components", d.component_count},
      {"groups", groups},
      {"objects", objects},
      {"materials", materials},
      {"texture_coordinates", info.texture_coordinate_count},
      {"maps", info.maps},
      {"measured", d.is_measured},
      {"box", {{"min", point(d.box.min)}, {"max", point(d.box.max)}}},
      {"suspected_unit", unit_json(info)},
      {"edge_length", spread_json(d.edge_length)},
      {"triangle_area", spread_json(d.triangle_area)},
      {"area", d.area},
      {"volume", d.volume},
      {"closed", d.is_closed},
      {"boundary", boundary_json(d)},
      {"all_crossings_found", info.self_crossings.is_complete},
      {"defects", defects_json(d, info.self_crossings)},
  };
  // In ASCII: the name of a file may hold what turns the direction of writing or commands a terminal.
  fmt::print("{}\n", json.dump(2, ' ', true, Json::error_handler_t::replace));
}

}  // namespace

void add_info_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("info", "Describe a mesh file and what is wrong with it");
  const auto options = std::make_shared<InfoOptions>();
  command
      ->add_option("file", options->file,
                   fmt::format("A mesh: {}", fmt::join(pliant::readable_mesh_extensions(), ", ")))
      ->type_name("FILE")
      ->required();
  add_import_options(*command, options->import);
  command->add_flag("--json", options->json, "Print JSON, in meters and square meters");
  command->footer("Example:\n  pliant info shirt.obj --scale 0.01 --up y");
  command->callback([options] {
    const Info info = examine(*options);
    options->json ? print_json(info) : print_text(info);
  });
}

}  // namespace pliant_cli
