#include "pliant_io/scene/detail/read_mesh.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "pliant/core/printable.h"
#include "pliant/mesh/join.h"
#include "pliant/mesh/loose.h"
#include "pliant/mesh/shapes/limits.h"
#include "pliant_io/mesh/mesh_file.h"
#include "pliant_io/scene/detail/option_reader.h"
#include "pliant_io/scene/detail/scene_files.h"
#include "pliant_io/scene/shape_options.h"

namespace pliant {
namespace {

using Keys = std::vector<std::string_view>;

Keys joined(Keys keys, const Keys& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

template <class Options>
Mesh read_shape_of(const Node& node, const Keys& more_keys) {
  Options options;
  read_options(node, options, joined({"shape"}, more_keys));
  return node.locate([&] { return make_shape(options); });
}

template <class... Options>
Mesh read_shape(const Node& node, const Keys& more_keys, std::tuple<Options...>*) {
  const Node type = node.require("shape");
  std::string name;
  read(type, name);
  Mesh mesh;
  const bool found = ((Options::shape == name && (mesh = read_shape_of<Options>(node, more_keys), true)) || ...);
  if (!found) {
    type.fail(fmt::format("unknown shape '{}'; {}", printable(name), suggestion_text(name, {Options::shape...})));
  }
  return mesh;
}

std::string vertices_text(Index count) {
  return fmt::format("{} {}", count, count == 1 ? "vertex" : "vertices");
}

Mesh read_mesh_file(const Node& node, const Keys& more_keys, std::vector<std::string>& warnings) {
  ImportOptions import;
  read_options(node, import, joined({"file", "source"}, more_keys));
  const Node file = node.require("file");
  const std::filesystem::path path = read_path(file);
  std::string source;
  read_optional(node, "source", source);
  std::error_code ignored;
  if (!source.empty() && !std::filesystem::exists(path, ignored)) {
    file.fail(fmt::format("{}: no such file; {}", printable_place(path.string()), printable(source)));
  }
  const bool drops_loose = std::exchange(import.drop_loose, false);
  Mesh mesh = file.locate([&] {
    for (const std::filesystem::path& each : mesh_files(path)) note_file(file, each);
    return read_mesh(path, import);
  });
  const Index dropped = drops_loose ? drop_loose_vertices(mesh) : 0;
  if (dropped > 0) {
    warnings.push_back(file.at(fmt::format("left out {} that no element has; the other {} are numbered anew",
                                           vertices_text(dropped), mesh.vertex_count())));
  }
  return mesh;
}

Mesh read_inline_mesh(const Node& node, const Keys& more_keys) {
  node.check_keys(joined({"vertices", "edges", "triangles", "tetrahedra"}, more_keys));
  Mesh mesh;
  read(node.require("vertices"), mesh.vertices);
  const Index count = mesh.vertex_count();
  if (const auto edges = node.find("edges")) mesh.edges = read_elements<2>(*edges, count);
  if (const auto triangles = node.find("triangles")) mesh.triangles = read_elements<3>(*triangles, count);
  if (const auto tetrahedra = node.find("tetrahedra")) mesh.tetrahedra = read_elements<4>(*tetrahedra, count);
  return mesh;
}

Mesh read_mesh(const Node& node, const Keys& more_keys, std::vector<std::string>& warnings);

/// Where a part is repeated, each time further on by the offset.
struct Copies {
  Index count = 1;
  Vec3 offset = Vec3::Zero();

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"count", "", "how many there are of the part", Range{1, 10000}}, self.count);
    field(OptionInfo{"offset", "m", "from one to the next"}, self.offset);
  }
};

/// Appends a part and its copies.
void read_part(const Node& node, std::vector<MeshPart>& parts, Real& vertex_count, std::vector<std::string>& warnings) {
  MeshPart part;
  part.mesh = read_mesh(node, {"name", "transform", "copies"}, warnings);
  read_optional(node, "name", part.name);
  if (const auto transform = node.find("transform")) apply_transform(*transform, part.mesh.vertices);
  Copies copies;
  if (const auto given = node.find("copies")) {
    read_options(*given, copies);
    given->locate([&] {
      check_options("copies", copies);
      require_vertex_count("copies", Real{1} * copies.count * part.mesh.vertex_count());
    });
  }
  vertex_count += Real{1} * copies.count * part.mesh.vertex_count();
  node.locate([&] { require_vertex_count("the parts up to this one", vertex_count); });
  for (Index i = 0; i < copies.count; ++i) {
    parts.push_back(part);
    parts.back().mesh.vertices.rowwise() += i * copies.offset.transpose();
  }
}

Mesh read_parts(const Node& node, const Keys& more_keys, std::vector<std::string>& warnings) {
  node.check_keys(joined({"parts", "weld"}, more_keys));
  const Node list = node.require("parts");
  list.require_list();
  std::vector<MeshPart> parts;
  Real vertex_count = 0;
  for (std::size_t i = 0; i < list.size(); ++i) read_part(list[i], parts, vertex_count, warnings);
  if (parts.empty()) list.fail("there is no part; add one");
  std::optional<Real> weld;
  if (const auto given = node.find("weld")) read(*given, weld.emplace());
  return node.locate([&] { return join(parts, weld); });
}

Mesh read_mesh(const Node& node, const Keys& more_keys, std::vector<std::string>& warnings) {
  if (node.is_text()) {
    const std::string name = printable(node.text());
    const std::string_view key = mesh_format(node.text()) ? "file" : "shape";
    node.fail(fmt::format("found '{0}' alone; write {{\"{1}\": \"{0}\"}}", name, key));
  }
  node.require_object();
  const std::string_view kind = node.require_one_of({"shape", "file", "vertices", "parts"});
  if (kind == "shape") return read_shape(node, more_keys, static_cast<Shapes*>(nullptr));
  if (kind == "file") return read_mesh_file(node, more_keys, warnings);
  return kind == "parts" ? read_parts(node, more_keys, warnings) : read_inline_mesh(node, more_keys);
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
  if (!(scale.minCoeff() > 0))
    node.fail("a scale of 0 or less flattens a body or turns it inside out; give one above 0");
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

/// One number for all, or of `each` vertex one.
Mass read_mass(const Node& node, std::string_view key, const Mesh& mesh) {
  if (key == "each") {
    std::vector<Real> masses;
    if (node.is_object()) {
      masses = read_mapped_values(node, mesh);
    } else {
      node.require_list(static_cast<std::size_t>(mesh.vertex_count()), "masses, one a vertex, or a map");
      read(node, masses);
    }
    return Mass::each(std::move(masses));
  }
  Real value = 0;
  read(node, value);
  return std::ranges::find(masses_of_one_number, key, &MassOfOneNumber::key)->make(value);
}

}  // namespace

Mesh read_mesh(const Node& node, std::vector<std::string>& warnings) {
  return read_mesh(node, {}, warnings);
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
  Keys keys = {"each"};
  Keys given;
  for (const auto& [key, make] : masses_of_one_number) {
    keys.push_back(key);
    if (key.ends_with("density") && node.has(key)) given.push_back(key);
  }
  node.check_keys(keys);
  const bool is_sum = given.size() > 1 && std::ranges::none_of(keys, [&](std::string_view key) {
                        return !key.ends_with("density") && node.has(key);
                      });
  if (!is_sum) given = {node.require_one_of(keys)};
  std::optional<Mass> sum;
  for (const std::string_view key : given) {
    Mass mass = read_mass(node.require(key), key, mesh);
    sum = sum ? *std::move(sum) + mass : std::move(mass);
  }
  return *std::move(sum);
}

Mass with_loose_vertices(Mass mass, const Node& node, const Mesh& mesh, std::vector<std::string>& warnings) {
  const bool is_of_vertices = std::ranges::any_of(mass.parts(), [](const Mass::Part& part) {
    return part.kind == Mass::Kind::each || part.kind == Mass::Kind::per_vertex;
  });
  const std::vector<Index> loose = loose_vertices(mesh);
  const Index others = mesh.vertex_count() - static_cast<Index>(loose.size());
  if (is_of_vertices || loose.empty() || others == 0) return mass;
  // With a mass for the loose ones, the others' are found, or named when they are wrong.
  std::vector<Real> masses(static_cast<std::size_t>(mesh.vertex_count()), 0);
  for (const Index vertex : loose) masses[static_cast<std::size_t>(vertex)] = 1;
  masses = node.locate([&] { return vertex_masses(mesh, std::move(mass) + Mass::each(std::move(masses)), "mass"); });
  for (const Index vertex : loose) masses[static_cast<std::size_t>(vertex)] = 0;
  const Real mean = std::accumulate(masses.begin(), masses.end(), Real{0}) / static_cast<Real>(others);
  for (const Index vertex : loose) masses[static_cast<std::size_t>(vertex)] = 1e-3 * mean;
  constexpr std::size_t shown = 5;
  const std::span first(loose.data(), std::min(loose.size(), shown));
  warnings.push_back(node.at(fmt::format(
      "{} in no element ({}{}): each gets a thousandth of the mean mass of the others; \"drop_loose\": true with the "
      "mesh file, or --drop-loose with a mesh, leaves them out",
      vertices_text(static_cast<Index>(loose.size())), fmt::join(first, ", "), loose.size() > shown ? ", ..." : "")));
  return Mass::each(std::move(masses));
}

}  // namespace pliant
