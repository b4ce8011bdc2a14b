#include "pliant/mesh/join.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/mesh/geometry.h"
#include "pliant/mesh/nearest_vertex.h"
#include "pliant/mesh/shapes/limits.h"
#include "pliant/mesh/topology.h"

namespace pliant {

namespace {

/// Which vertex each vertex becomes, before those left over are numbered anew.
std::vector<Index> merged_vertices(const Positions& x, std::span<const Index> part_ends, Real weld) {
  std::vector<Index> target(static_cast<std::size_t>(x.rows()));
  std::iota(target.begin(), target.end(), 0);
  const NearestVertex tree(x);
  std::vector<char> is_merged(target.size(), 0);
  // About 50 a vertex, but all of them for a vertex as far from every other: in the middle of a sphere, say.
  std::int64_t may_look_at = 1'000'000 + 300 * static_cast<std::int64_t>(target.size());
  for (std::size_t part = 1; part < part_ends.size(); ++part) {
    const Index begin = part_ends[part - 1];
    std::map<Index, std::pair<Real, Index>> nearest_of;  // by target: distance squared, vertex
    for (Index v = begin; v < part_ends[part]; ++v) {
      const auto found = tree.find(row(x, v), begin, weld, is_merged);
      may_look_at -= found.looked_at;
      if (may_look_at < 0) fail_input(fmt::format("weld: {} m reaches too many vertices; give a smaller one", weld));
      if (found.vertex < 0) continue;
      const std::pair candidate{found.squared, v};
      const auto [entry, is_new] = nearest_of.emplace(found.vertex, candidate);
      if (!is_new) entry->second = std::min(entry->second, candidate);
    }
    for (const auto& [to, from] : nearest_of) {
      target[static_cast<std::size_t>(from.second)] = to;
      is_merged[static_cast<std::size_t>(from.second)] = 1;
    }
  }
  return target;
}

/// Appends parts to a whole.
class Joiner {
 public:
  explicit Joiner(Mesh& whole) : whole_(whole) { whole_.faces.offsets.push_back(0); }

  /// `vertices[i]` is what vertex i of the part is in the whole.
  void add(const MeshPart& part, std::span<const Index> vertices) {
    vertices_ = vertices;
    append(part.mesh.edges, whole_.edges);
    append(part.mesh.triangles, whole_.triangles);
    append(part.mesh.tetrahedra, whole_.tetrahedra);
    const Index first_face = whole_.faces.face_count();
    const Index first_texture = static_cast<Index>(whole_.texture_coordinates.rows());
    append_texture_coordinates(part.mesh);
    append_faces(part.mesh, first_texture);
    append_maps(part.mesh);
    whole_.collapsed_face_count += part.mesh.collapsed_face_count;
    for (const std::string& library : part.mesh.material_libraries) {
      if (libraries_.insert(library).second) whole_.material_libraries.push_back(library);
    }
    for (const FaceGroup& group : part.mesh.groups) {
      FaceGroup& ours = face_group(group.name, group.kind);
      for (const Index face : group.faces) ours.faces.push_back(first_face + face);
    }
    for (const VertexGroup& group : part.mesh.vertex_groups) {
      for (const Index vertex : group.vertices) vertex_group(group.name).vertices.push_back(at(vertex));
    }
    if (part.name.empty()) return;
    std::vector<Index>& named = vertex_group(part.name).vertices;
    named.insert(named.end(), vertices.begin(), vertices.end());
    if (first_face == whole_.faces.face_count()) return;
    FaceGroup& group = face_group(part.name, FaceGroupKind::group);
    for (Index face = first_face; face < whole_.faces.face_count(); ++face) group.faces.push_back(face);
  }

  void finish() {
    if (whole_.faces.face_count() == 0) whole_.faces = {};
    if (whole_.texture_coordinates.rows() == 0) whole_.faces.texture_coordinates.clear();
    for (FaceGroup& group : whole_.groups) sort(group.faces);
    for (VertexGroup& group : whole_.vertex_groups) sort(group.vertices);
  }

 private:
  Index at(Index vertex) const { return vertices_[static_cast<std::size_t>(vertex)]; }

  template <class Element>
  void append(const std::vector<Element>& elements, std::vector<Element>& ours) const {
    for (Element element : elements) {
      for (Index& vertex : element) vertex = at(vertex);
      ours.push_back(element);
    }
  }

  void append_texture_coordinates(const Mesh& part) {
    auto& ours = whole_.texture_coordinates;
    const Eigen::Index old_rows = ours.rows();
    ours.conservativeResize(old_rows + part.texture_coordinates.rows(), 2);
    ours.bottomRows(part.texture_coordinates.rows()) = part.texture_coordinates;
  }

  /// A vertex of several parts has the number of the last of them.
  void append_maps(const Mesh& part) {
    for (const VertexMap& map : part.maps) {
      const auto [found, is_new] = maps_.emplace(map.name, whole_.maps.size());
      if (is_new) whole_.maps.push_back({map.name, std::vector<Real>(static_cast<std::size_t>(whole_.vertex_count()))});
      std::vector<Real>& ours = whole_.maps[found->second].values;
      for (std::size_t i = 0; i < map.values.size(); ++i) ours[static_cast<std::size_t>(vertices_[i])] = map.values[i];
    }
  }

  void append_faces(const Mesh& part, Index first_texture) {
    PolygonFaces& ours = whole_.faces;
    const auto end_face = [&] { ours.offsets.push_back(static_cast<Index>(ours.vertices.size())); };
    const PolygonFaces& faces = part.faces;
    for (Index face = 0; face < faces.face_count(); ++face) {
      const auto begin = static_cast<std::size_t>(faces.offsets[static_cast<std::size_t>(face)]);
      const auto end = static_cast<std::size_t>(faces.offsets[static_cast<std::size_t>(face) + 1]);
      for (std::size_t corner = begin; corner < end; ++corner) {
        ours.vertices.push_back(at(faces.vertices[corner]));
        const Index texture = faces.texture_coordinates.empty() ? -1 : faces.texture_coordinates[corner];
        ours.texture_coordinates.push_back(texture < 0 ? -1 : first_texture + texture);
      }
      end_face();
    }
    const auto append_triangles = [&](const std::vector<Triangle>& triangles) {
      for (const Triangle& triangle : triangles) {
        for (const Index vertex : triangle) {
          ours.vertices.push_back(at(vertex));
          ours.texture_coordinates.push_back(-1);
        }
        end_face();
      }
    };
    if (faces.face_count() == 0) append_triangles(part.triangles);
    append_triangles(boundary_triangles(part.tetrahedra));
  }

  FaceGroup& face_group(const std::string& name, FaceGroupKind kind) {
    const auto [found, is_new] = face_groups_.emplace(std::pair{name, kind}, whole_.groups.size());
    if (is_new) whole_.groups.push_back({name, kind, {}});
    return whole_.groups[found->second];
  }

  VertexGroup& vertex_group(const std::string& name) {
    const auto [found, is_new] = vertex_groups_.emplace(name, whole_.vertex_groups.size());
    if (is_new) whole_.vertex_groups.push_back({name, {}});
    return whole_.vertex_groups[found->second];
  }

  static void sort(std::vector<Index>& indices) {
    std::ranges::sort(indices);
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  }

  Mesh& whole_;
  std::span<const Index> vertices_;
  std::map<std::pair<std::string, FaceGroupKind>, std::size_t> face_groups_;
  std::map<std::string, std::size_t> vertex_groups_;
  std::map<std::string, std::size_t> maps_;
  std::set<std::string> libraries_;
};

/// Where each part's vertices end among all of them.
std::vector<Index> ends_of(std::span<const MeshPart> parts) {
  Real count = 0;
  for (const MeshPart& part : parts) count += static_cast<Real>(part.mesh.vertices.rows());
  require_vertex_count("parts", count);
  std::vector<Index> ends;
  for (const MeshPart& part : parts) ends.push_back((ends.empty() ? 0 : ends.back()) + part.mesh.vertex_count());
  return ends;
}

/// A map that few vertices have is stretched over all of them: refuses what would take far more memory than it came in.
void check_maps(std::span<const MeshPart> parts, Index vertex_count) {
  std::set<std::string_view> names;
  Real given = 0;
  for (const MeshPart& part : parts) {
    for (const VertexMap& map : part.mesh.maps) {
      names.insert(map.name);
      given += static_cast<Real>(map.values.size());
    }
  }
  const Real needed = static_cast<Real>(names.size()) * vertex_count;
  if (needed > 1e7 + 4 * given) {
    fail_input(
        fmt::format("the parts have {} vertex maps of different names, for {} vertices; leave some out of the files",
                    names.size(), vertex_count));
  }
}

}  // namespace

Mesh join(std::span<const MeshPart> parts, std::optional<Real> weld) {
  if (weld && !(*weld >= 0 && std::isfinite(*weld))) {
    fail_input(fmt::format("weld: {} is out of range; give a finite distance from 0 [m]", *weld));
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    check_mesh(parts[i].mesh, parts[i].name.empty() ? fmt::format("part {}", i) : "part '" + parts[i].name + "'");
  }
  const std::vector<Index> ends = ends_of(parts);
  const Index count = ends.empty() ? 0 : ends.back();
  check_maps(parts, count);
  Positions x(count, 3);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Index rows = parts[i].mesh.vertex_count();
    x.middleRows(ends[i] - rows, rows) = parts[i].mesh.vertices;
  }

  std::vector<Index> target(static_cast<std::size_t>(count));
  std::iota(target.begin(), target.end(), 0);
  if (weld) target = merged_vertices(x, ends, *weld);
  Mesh whole;
  whole.vertices.resize(count, 3);
  std::vector<Index> number(target.size());
  Index kept = 0;
  for (Index v = 0; v < count; ++v) {
    const auto i = static_cast<std::size_t>(v);
    if (target[i] == v) whole.vertices.row(kept) = x.row(v);
    number[i] = target[i] == v ? kept++ : number[static_cast<std::size_t>(target[i])];
  }
  whole.vertices.conservativeResize(kept, 3);

  Joiner joiner(whole);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto rows = static_cast<std::size_t>(parts[i].mesh.vertex_count());
    joiner.add(parts[i], std::span(number).subspan(static_cast<std::size_t>(ends[i]) - rows, rows));
  }
  joiner.finish();
  return whole;
}

}  // namespace pliant
