// VTK's UnstructuredGrid in XML.
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "pliant_io/mesh/detail/text_lexer.h"
#include "pliant_io/mesh/detail/vtk_cells.h"
#include "pliant_io/mesh/detail/vtu_document.h"
#include "pliant_io/mesh/vtk.h"

namespace pliant {

namespace {

class VtuReader {
 public:
  explicit VtuReader(const ByteSource& source) : source_(source), document_(source), cells_(mesh_, source.size()) {}

  Mesh read() {
    read_points();
    Index first = 0;
    for (const pugi::xml_node& piece : document_.grid().children("Piece")) {
      const auto count = static_cast<Index>(document_.count(piece, "NumberOfPoints", max_index_count));
      read_cells(piece, first, count);
      first += count;
    }
    cells_.finish();
    if (piece_count_ == 1) read_maps(document_.grid().child("Piece"));
    return std::move(mesh_);
  }

 private:
  /// Of all pieces, since the order of a tetrahedron's corners depends on where they are.
  void read_points() {
    std::uint64_t total = 0;
    for (const pugi::xml_node& piece : document_.grid().children("Piece")) {
      total += static_cast<std::uint64_t>(document_.count(piece, "NumberOfPoints", max_index_count));
      ++piece_count_;
      if (total > max_index_count || !document_.has_room(3 * total)) {
        document_.fail(piece,
                       fmt::format("{} points, more than a file of this size holds; it may be cut short", total));
      }
    }
    if (total == 0) source_.fail("no points; give at least one");
    mesh_.vertices.resize(static_cast<Eigen::Index>(total), 3);
    Eigen::Index first = 0;
    for (const pugi::xml_node& piece : document_.grid().children("Piece")) {
      const auto count = static_cast<Eigen::Index>(document_.count(piece, "NumberOfPoints", max_index_count));
      if (count > 0) read_points_of(piece, first, count);
      first += count;
    }
  }

  void read_points_of(const pugi::xml_node& piece, Eigen::Index first, Eigen::Index count) {
    const pugi::xml_node array = piece.child("Points").child("DataArray");
    if (!array) document_.fail(piece, "a piece without an array in its Points; save it anew");
    if (document_.components(array) != 3) document_.fail(array, "points that have not 3 coordinates; save it anew");
    Real* const values = mesh_.vertices.data() + 3 * first;
    document_.read_reals(array, std::span(values, 3 * static_cast<std::size_t>(count)));
    for (Eigen::Index v = first; v < first + count; ++v) {
      if (mesh_.vertices.row(v).allFinite()) continue;
      document_.fail(array, fmt::format("a coordinate of vertex {} is not finite; give a number", v));
    }
  }

  pugi::xml_node array_of(const pugi::xml_node& cells, const char* name) const {
    const pugi::xml_node array = cells.find_child_by_attribute("DataArray", "Name", name);
    if (!array) document_.fail(cells, fmt::format("cells without an array \"{}\"; save it anew", name));
    return array;
  }

  void read_cells(const pugi::xml_node& piece, Index first_vertex, Index vertex_count) {
    const pugi::xml_node cells = piece.child("Cells");
    const std::int64_t count = document_.count(piece, "NumberOfCells", max_index_count);
    if (count == 0) return;
    if (!cells) document_.fail(piece, "a piece without Cells; save it anew");
    const pugi::xml_node connectivity = array_of(cells, "connectivity");
    std::vector<Index> corners = document_.read_indices(connectivity, vertex_count - std::int64_t{1}, "vertex");
    for (Index& corner : corners) corner += first_vertex;
    const std::vector<Index> ends = document_.read_indices(array_of(cells, "offsets"), std::ssize(corners), "end");
    const std::vector<Index> types = document_.read_indices(array_of(cells, "types"), 255, "type");
    if (std::ssize(ends) != count || std::ssize(types) != count) {
      document_.fail(
          cells, fmt::format("{} cells with {} offsets and {} types; save it anew", count, ends.size(), types.size()));
    }
    Index begin = 0;
    for (std::size_t c = 0; c < ends.size(); begin = ends[c++]) {
      std::string message;
      if (ends[c] < begin) {
        message = fmt::format("its offset is {} behind one of {}; save it anew", ends[c], begin);
      } else {
        const auto size = static_cast<std::size_t>(ends[c] - begin);
        message = cells_.add(types[c], std::span(corners).subspan(static_cast<std::size_t>(begin), size));
      }
      if (!message.empty()) document_.fail(cells, fmt::format("cell {}: {}", c, message));
    }
  }

  /// What nothing can be computed with is left out rather than the whole mesh refused: it is not its shape.
  void read_maps(const pugi::xml_node& piece) {
    std::set<std::string> names;
    for (const pugi::xml_node& array : piece.child("PointData").children("DataArray")) {
      const std::string name = array.attribute("Name").value();
      if (document_.components(array) != 1 || !xml_type(array.attribute("type").value()) || name.empty()) continue;
      if (!names.insert(name).second) continue;
      VertexMap map{name, std::vector<Real>(static_cast<std::size_t>(mesh_.vertex_count()))};
      document_.read_reals(array, map.values);
      if (std::ranges::all_of(map.values, [](Real value) { return std::isfinite(value); })) {
        mesh_.maps.push_back(std::move(map));
      }
    }
  }

  const ByteSource& source_;
  VtuDocument document_;
  Mesh mesh_;
  VtkCellBuilder cells_;
  std::size_t piece_count_ = 0;
};

}  // namespace

Mesh read_vtu(const ByteSource& source) {
  return VtuReader(source).read();
}

}  // namespace pliant
