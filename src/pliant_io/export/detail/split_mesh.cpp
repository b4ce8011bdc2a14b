#include "pliant_io/export/detail/split_mesh.h"

#include <algorithm>
#include <unordered_map>

#include <fmt/format.h>

#include "pliant/core/error.h"

namespace pliant {
namespace {

/// Takes the elements of the whole mesh one after the other to the bodies that they belong to.
class MeshSplitter {
 public:
  MeshSplitter(const Mesh& mesh, const std::vector<BodyRange>& ranges, const std::string& name)
      : mesh_(mesh), name_(name), parts_(ranges.size()) {
    for (const BodyRange& range : ranges) {
      bodies_.push_back({range.name, {}, range.first_vertex});
      bodies_.back().mesh.material_libraries = mesh.material_libraries;
      bodies_.back().mesh.vertices = mesh.vertices.middleRows(range.first_vertex, range.vertex_count);
    }
  }

  std::vector<Body> split() {
    split_faces();
    for (const Triangle& triangle : mesh_.triangles) {
      const std::size_t body = body_of(triangle);
      bodies_[body].mesh.triangles.push_back(moved(triangle, bodies_[body]));
    }
    for (const Edge& edge : mesh_.edges) {
      const std::size_t body = body_of(edge);
      bodies_[body].mesh.edges.push_back(moved(edge, bodies_[body]));
    }
    split_groups();
    for (std::size_t body = 0; body < bodies_.size(); ++body) take_texture(bodies_[body].mesh, parts_[body]);
    return std::move(bodies_);
  }

 private:
  struct Part {
    std::unordered_map<Index, Index> texture;  ///< row of the part by that of the whole
    std::vector<Index> rows;                   ///< and back
  };

  std::size_t body_of(std::span<const Index> vertices) const {
    const auto owner = [&](Index vertex) {
      const auto next = std::ranges::upper_bound(bodies_, vertex, {}, &Body::first_vertex);
      return static_cast<std::size_t>(next - bodies_.begin()) - 1;
    };
    const std::size_t body = owner(vertices[0]);
    for (const Index vertex : vertices) {
      if (owner(vertex) == body) continue;
      fail_input(
          fmt::format("{}: an element goes from vertex {} to vertex {}, which are of two bodies; run the scene "
                      "again",
                      name_, vertices[0] + std::int64_t{1}, vertex + std::int64_t{1}));
    }
    return body;
  }

  template <typename Element>
  static Element moved(Element element, const Body& body) {
    for (Index& vertex : element) vertex -= body.first_vertex;
    return element;
  }

  void split_faces() {
    const PolygonFaces& faces = mesh_.faces;
    for (Index face = 0; face < faces.face_count(); ++face) {
      const auto first = static_cast<std::size_t>(faces.offsets[static_cast<std::size_t>(face)]);
      const auto last = static_cast<std::size_t>(faces.offsets[static_cast<std::size_t>(face) + 1]);
      const std::size_t body = body_of(std::span(faces.vertices).subspan(first, last - first));
      PolygonFaces& own = bodies_[body].mesh.faces;
      if (own.offsets.empty()) own.offsets.push_back(0);
      for (std::size_t corner = first; corner < last; ++corner) {
        own.vertices.push_back(faces.vertices[corner] - bodies_[body].first_vertex);
        if (faces.texture_coordinates.empty()) continue;
        own.texture_coordinates.push_back(texture_of(parts_[body], faces.texture_coordinates[corner]));
      }
      own.offsets.push_back(static_cast<Index>(own.vertices.size()));
      body_of_face_.push_back(body);
      face_of_body_.push_back(own.face_count() - 1);
    }
  }

  static Index texture_of(Part& part, Index row) {
    if (row < 0) return -1;
    const auto [entry, is_new] = part.texture.try_emplace(row, static_cast<Index>(part.rows.size()));
    if (is_new) part.rows.push_back(row);
    return entry->second;
  }

  /// Objects are the bodies themselves.
  void split_groups() {
    for (const FaceGroup& group : mesh_.groups) {
      if (group.kind == FaceGroupKind::object) continue;
      std::unordered_map<std::size_t, std::size_t> place;  // of the group in each body
      for (const Index face : group.faces) {
        const std::size_t body = body_of_face_[static_cast<std::size_t>(face)];
        std::vector<FaceGroup>& groups = bodies_[body].mesh.groups;
        const auto [entry, is_new] = place.try_emplace(body, groups.size());
        if (is_new) groups.push_back({group.name, group.kind, {}});
        groups[entry->second].faces.push_back(face_of_body_[static_cast<std::size_t>(face)]);
      }
    }
  }

  void take_texture(Mesh& mesh, const Part& part) const {
    if (part.rows.empty()) {
      mesh.faces.texture_coordinates.clear();
      return;
    }
    mesh.texture_coordinates.resize(static_cast<Eigen::Index>(part.rows.size()), 2);
    for (std::size_t i = 0; i < part.rows.size(); ++i) {
      mesh.texture_coordinates.row(static_cast<Eigen::Index>(i)) = mesh_.texture_coordinates.row(part.rows[i]);
    }
  }

  const Mesh& mesh_;
  const std::string& name_;
  std::vector<Body> bodies_;
  std::vector<Part> parts_;
  std::vector<std::size_t> body_of_face_;
  std::vector<Index> face_of_body_;
};

}  // namespace

std::vector<Body> split_mesh(const Mesh& mesh, const std::vector<BodyRange>& bodies, const std::string& name) {
  const std::int64_t count = bodies.empty() ? 0 : std::int64_t{bodies.back().first_vertex} + bodies.back().vertex_count;
  if (count != mesh.vertex_count()) {
    fail_input(fmt::format("{}: has {} vertices, but the bodies in run.json {}; run the scene again", name,
                           mesh.vertex_count(), count));
  }
  if (bodies.size() == 1) return {{bodies[0].name, mesh, 0}};
  return MeshSplitter(mesh, bodies, name).split();
}

}  // namespace pliant
