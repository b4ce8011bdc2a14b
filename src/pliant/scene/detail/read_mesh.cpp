#include "pliant/scene/detail/read_mesh.h"

#include <algorithm>
#include <array>
#include <numbers>

#include <fmt/ranges.h>

#include "pliant/mesh/io/mesh_file.h"
#include "pliant/scene/detail/option_reader.h"
#include "pliant/scene/detail/scene_files.h"
#include "pliant/scene/detail/shape_options.h"

namespace pliant {
namespace {

template <class Shape>
Mesh read_shape_of(const Node& node) {
  Shape shape;
  std::vector<std::string_view> keys = {"shape"};
  shape.visit([&](std::string_view key, const auto&) { keys.push_back(key); });
  node.check_keys(keys);
  shape.visit([&](std::string_view key, auto& option) { read_optional(node, key, option); });
  return node.locate([&] { return shape.make(); });
}

template <class... Shape>
Mesh read_shape(const Node& node, std::tuple<Shape...>) {
  const Node type = node.require("shape");
  std::string name;
  read(type, name);
  Mesh mesh;
  const bool found = ((Shape::name == name && (mesh = read_shape_of<Shape>(node), true)) || ...);
  if (!found) {
    type.fail(fmt::format("'{}' is no shape; known, the nearest first: {}", printable(name),
                          nearest_names_text(name, {Shape::name...})));
  }
  return mesh;
}

Mesh read_mesh_file(const Node& node) {
  ImportOptions options;
  read_options(node, options, {"file"});
  const Node file = node.require("file");
  const std::filesystem::path path = read_path(file);
  const std::optional<MeshFormat> format = mesh_format(path);
  if (!format) {
    constexpr auto known = choice_names(MeshFormat{});
    file.fail(fmt::format("{}: not the extension of a mesh format; known: .{}", printable_place(path.string()),
                          fmt::join(known, ", .")));
  }
  const NamedFile named = read_named_file(file);
  return file.locate([&] { return parse_mesh(named.bytes, named.path.string(), *format, options); });
}

Mesh read_inline_mesh(const Node& node) {
  node.check_keys({"vertices", "edges", "triangles", "tetrahedra"});
  Mesh mesh;
  read(node.require("vertices"), mesh.vertices);
  const Index count = mesh.vertex_count();
  if (const auto edges = node.find("edges")) mesh.edges = read_elements<2>(*edges, count);
  if (const auto triangles = node.find("triangles")) mesh.triangles = read_elements<3>(*triangles, count);
  if (const auto tetrahedra = node.find("tetrahedra")) mesh.tetrahedra = read_elements<4>(*tetrahedra, count);
  return mesh;
}

Vec3 read_scale(const Node& node) {
  Vec3 scale;
  if (node.is_list()) {
    read(node, scale);
  } else {
    Real factor = 1;
    read(node, factor);
    scale.setConstant(factor);
  }
  if (!(scale.minCoeff() > 0)) node.fail("a scale must be above 0, since others turn a body inside out or flatten it");
  return scale;
}

Mat3 read_rotation(const Node& node) {
  node.check_keys({"axis", "degrees"});
  Vec3 axis;
  Real degrees = 0;
  read(node.require("axis"), axis);
  read(node.require("degrees"), degrees);
  const Real length = axis.stableNorm();
  if (!(length > 0)) node.require("axis").fail("an axis of length 0 has no direction; give another");
  return Eigen::AngleAxis<Real>(degrees * std::numbers::pi / 180, axis / length).toRotationMatrix();
}

struct MassOfOneNumber {
  std::string_view key;
  Mass (*make)(Real);
};
constexpr std::array masses_of_one_number = {
    MassOfOneNumber{"per_vertex", Mass::per_vertex},     MassOfOneNumber{"total", Mass::total},
    MassOfOneNumber{"area_density", Mass::area_density}, MassOfOneNumber{"density", Mass::density},
    MassOfOneNumber{"line_density", Mass::line_density},
};

}  // namespace

Mesh read_mesh(const Node& node) {
  node.require_object();
  const std::string_view kind = node.require_one_of({"shape", "file", "vertices"});
  if (kind == "shape") return read_shape(node, Shapes{});
  return kind == "file" ? read_mesh_file(node) : read_inline_mesh(node);
}

void apply_transform(const Node& node, Positions& positions) {
  node.check_keys({"scale", "rotate", "translate"});
  if (const auto scale = node.find("scale")) positions = positions * read_scale(*scale).asDiagonal();
  if (const auto rotate = node.find("rotate")) positions = (positions * read_rotation(*rotate).transpose()).eval();
  Vec3 translation = Vec3::Zero();
  read_optional(node, "translate", translation);
  positions.rowwise() += translation.transpose();
}

Mass read_mass(const Node& node, const Mesh& mesh) {
  std::vector<std::string_view> keys = {"each"};
  for (const auto& [key, make] : masses_of_one_number) keys.push_back(key);
  node.check_keys(keys);
  const std::string_view key = node.require_one_of(keys);
  if (key == "each") {
    const Node each = node.require(key);
    std::vector<Real> masses;
    if (each.is_object()) {
      masses = read_mapped_values(each, mesh);
    } else {
      each.require_list(static_cast<std::size_t>(mesh.vertex_count()), "masses, one a vertex, or a map");
      read(each, masses);
    }
    return Mass::each(std::move(masses));
  }
  Real value = 0;
  read(node.require(key), value);
  return std::ranges::find(masses_of_one_number, key, &MassOfOneNumber::key)->make(value);
}

}  // namespace pliant
