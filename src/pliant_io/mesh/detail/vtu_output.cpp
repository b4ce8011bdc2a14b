#include "pliant_io/mesh/detail/vtu_output.h"

#include <algorithm>
#include <array>
#include <bit>

#include <fmt/format.h>

#include "pliant/core/printable.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/files/base64.h"
#include "pliant_io/files/compression.h"
#include "pliant_io/mesh/detail/mesh_output.h"
#include "pliant_io/mesh/detail/vtk_cells.h"

namespace pliant {

static_assert(std::endian::native == std::endian::little, "arrays of .vtu files are written as they lie in memory");

namespace {

void append_count(std::string& bytes, std::uint64_t count) {
  std::array<char, sizeof count> raw;
  std::memcpy(raw.data(), &count, sizeof count);
  bytes.append(raw.data(), raw.size());
}

/// In blocks, with their sizes in front, as VTK reads them.
std::string encoded(std::string_view bytes) {
  constexpr std::size_t block = 1 << 20;
  std::string head;
  std::string packed;
  append_count(head, (bytes.size() + block - 1) / block);
  append_count(head, block);
  append_count(head, bytes.size() % block);
  for (std::size_t begin = 0; begin < bytes.size(); begin += block) {
    const std::string one = compressed(bytes.substr(begin, block));
    append_count(head, one.size());
    packed += one;
  }
  return base64(head) + base64(packed);
}

std::string array_element(const VtuArray& array) {
  return fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="binary">{}</DataArray>)"
                     "\n",
                     array.type, xml_attribute_text(array.name), array.components, encoded(array.bytes));
}

}  // namespace

std::string xml_attribute_text(std::string_view text) {
  std::string result;
  for (const char c : printable(text, std::max<std::size_t>(text.size(), 8))) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

void VtuCells::add(const Mesh& mesh, Index first_vertex) {
  const std::size_t before = types_.size();
  for (const Tetrahedron& each : mesh.tetrahedra) add_cell(vtk_cell::tetrahedron, each, first_vertex);
  if (mesh.tetrahedra.empty()) {
    const VisibleFaces faces(mesh);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const std::size_t corners = faces[f].size();
      const std::int64_t type = corners == 3 ? vtk_cell::triangle : corners == 4 ? vtk_cell::quad : vtk_cell::polygon;
      add_cell(type, faces[f], first_vertex);
    }
  }
  for (const Edge& edge : mesh.edges) add_cell(vtk_cell::line, edge, first_vertex);
  if (types_.size() > before) return;
  for (Index v = 0; v < mesh.vertex_count(); ++v) add_cell(vtk_cell::vertex, std::array{v}, first_vertex);
}

void VtuCells::add_cell(std::int64_t type, std::span<const Index> corners, Index first_vertex) {
  for (const Index corner : corners) corners_.push_back(std::int64_t{first_vertex} + corner);
  ends_.push_back(static_cast<std::int64_t>(corners_.size()));
  types_.push_back(static_cast<std::uint8_t>(type));
}

std::string VtuCells::element() const {
  return "<Cells>\n" + array_element(vtu_array("connectivity", 1, std::span(corners_))) +
         array_element(vtu_array("offsets", 1, std::span(ends_))) +
         array_element(vtu_array("types", 1, std::span(types_))) + "</Cells>\n";
}

void write_vtu_file(const std::filesystem::path& path, const Positions& positions, const VtuFrame& frame,
                    std::span<const VtuArray> point_data) {
  AtomicFile file(path);
  file.write(R"(<?xml version="1.0" encoding="UTF-8"?>)"
             "\n"
             R"(<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64")"
             R"( compressor="vtkZLibDataCompressor">)"
             "\n<UnstructuredGrid>\n");
  file.write(fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n", positions.rows(),
                         frame.cell_count));
  const std::span<const Real> numbers(positions.data(), static_cast<std::size_t>(positions.size()));
  file.write(array_element(vtu_array("Points", 3, numbers)));
  file.write("</Points>\n");
  file.write(frame.cells);
  file.write("<PointData>\n");
  for (const VtuArray& array : point_data) file.write(array_element(array));
  file.write("</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  file.commit();
}

}  // namespace pliant
