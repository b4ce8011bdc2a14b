#pragma once
// Cells of VTK's files as elements of a mesh.
#include <cstdint>
#include <span>
#include <string>

#include "pliant_io/mesh/detail/polygon_builder.h"

namespace pliant {

/// The numbers of VTK's types of cells that are read and written.
namespace vtk_cell {
inline constexpr std::int64_t vertex = 1;
inline constexpr std::int64_t vertices = 2;
inline constexpr std::int64_t line = 3;
inline constexpr std::int64_t polyline = 4;
inline constexpr std::int64_t triangle = 5;
inline constexpr std::int64_t strip = 6;
inline constexpr std::int64_t polygon = 7;
inline constexpr std::int64_t pixel = 8;
inline constexpr std::int64_t quad = 9;
inline constexpr std::int64_t tetrahedron = 10;
}  // namespace vtk_cell

class VtkCellBuilder {
 public:
  /// `file_size` bounds how much may be made of a file, see PolygonBuilder.
  VtkCellBuilder(Mesh& mesh, std::uint64_t file_size) : mesh_(mesh), polygons_(mesh, file_size, 0) {}

  /// Adds a cell of vertices in range. What is wrong with it, as an error message without its place, or nothing.
  std::string add(std::int64_t type, std::span<const Index> corners);

  /// To be called once, last. Faces beside tetrahedra are left out, and lines that are edges of faces or tetrahedra:
  /// mesh generators save the borders of what they mesh.
  void finish();

 private:
  std::string add_lines(std::span<const Index> corners);
  std::string add_strip(std::span<const Index> corners);
  std::string add_face(std::span<const Index> corners);

  Mesh& mesh_;
  PolygonBuilder polygons_;
};

}  // namespace pliant
