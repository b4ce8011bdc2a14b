#include "pliant_io/mesh/detail/mesh_output.h"

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/mesh/topology.h"

namespace pliant {

void check_positions(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions) {
  if (positions.rows() != mesh.vertices.rows()) {
    fail_input(fmt::format("{}: {} positions for a mesh of {} vertices; give one for each", path.string(),
                           positions.rows(), mesh.vertices.rows()));
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (row(positions, v).allFinite()) continue;
    fail_input(
        fmt::format("{}: the position of vertex {} is not finite; write a state before it diverged", path.string(), v));
  }
}

std::vector<Triangle> visible_triangles(const Mesh& mesh) {
  return mesh.triangles.empty() ? boundary_triangles(mesh.tetrahedra) : mesh.triangles;
}

VisibleFaces::VisibleFaces(const Mesh& mesh) {
  if (mesh.faces.face_count() > 0) {
    polygons_ = &mesh.faces;
  } else {
    triangles_ = visible_triangles(mesh);
  }
}

std::span<const Index> VisibleFaces::operator[](std::size_t face) const {
  if (polygons_ == nullptr) return triangles_[face];
  return std::span(polygons_->vertices).subspan(first_corner(face), first_corner(face + 1) - first_corner(face));
}

bool VisibleFaces::has_texture_by_vertex(const Mesh& mesh) const {
  return has_texture() && mesh.texture_coordinates.rows() == mesh.vertices.rows() &&
         polygons_->texture_coordinates == polygons_->vertices;
}

void TextOutput::end_line() {
  text_ += '\n';
  flush_when_full();
}

void TextOutput::flush_when_full() {
  constexpr std::size_t block = 1 << 20;
  if (text_.size() >= block) flush();
}

void TextOutput::flush() {
  file_.write(text_);
  text_.clear();
}

}  // namespace pliant
