#include <cmath>
#include <string>

#include "pliant_io/files/atomic_file.h"
#include "pliant_io/mesh/detail/colors.h"
#include "pliant_io/mesh/detail/mesh_output.h"
#include "pliant_io/mesh/off.h"

namespace pliant {

namespace {

/// A reader tells colors up to 1 from those up to 255 by the decimal point.
void write_color(TextOutput& text, Real value, const ColorMaps& colors) {
  text << " " << value;
  if (!colors.are_bytes && value == std::floor(value) && std::abs(value) < 1e5) text << ".0";
}

void write_vertices(TextOutput& text, const Mesh& mesh, const Positions& positions, const ColorMaps& colors,
                    const VisibleFaces& faces) {
  const bool has_texture = faces.has_texture_by_vertex(mesh);
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    text << positions(v, 0) << " " << positions(v, 1) << " " << positions(v, 2);
    for (std::size_t k = 0; k < colors.count; ++k) {
      write_color(text, colors.channels[k]->values[static_cast<std::size_t>(v)], colors);
    }
    if (has_texture) text << " " << mesh.texture_coordinates(v, 0) << " " << mesh.texture_coordinates(v, 1);
    text.end_line();
  }
}

}  // namespace

void write_off(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions) {
  check_positions(path, mesh, positions);
  AtomicFile file(path);
  TextOutput text(file);
  const VisibleFaces faces(mesh);
  const ColorMaps colors(mesh);
  text << (faces.has_texture_by_vertex(mesh) ? "ST" : "") << (colors.count > 0 ? "C" : "") << "OFF\n# Pliant\n";
  text << mesh.vertex_count() << " " << faces.size() + mesh.edges.size() << " 0\n";
  write_vertices(text, mesh, positions, colors, faces);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    text << faces[f].size();
    for (const Index vertex : faces[f]) text << " " << vertex;
    text.end_line();
  }
  for (const auto& [a, b] : mesh.edges) {
    text << "2 " << a << " " << b;
    text.end_line();
  }
  text.flush();
  file.commit();
}

}  // namespace pliant
