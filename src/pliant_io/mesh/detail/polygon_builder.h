#pragma once
// How the readers add polygons to a mesh: with their fan of triangles, checked, and within a share of the file's size.
#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "pliant/mesh/mesh.h"

namespace pliant {

inline constexpr std::uint64_t max_index_count = std::numeric_limits<Index>::max();

class PolygonBuilder {
 public:
  /// `first_index` is the number of the first vertex in messages. A file of `file_size` bytes may hold half as many
  /// corners, and a million more: only files made to exhaust the memory, of one byte an index, hold more.
  PolygonBuilder(Mesh& mesh, std::uint64_t file_size, Index first_index);

  /// Makes room; what comes may be more or less.
  void reserve(std::uint64_t faces, std::uint64_t corners);

  /// A corner of the next face. `texture` is a row of Mesh::texture_coordinates, -1 for none.
  void add_corner(Index vertex) {
    mesh_.faces.vertices.push_back(vertex);
    if (has_texture_) mesh_.faces.texture_coordinates.push_back(-1);
  }
  void add_corner(Index vertex, Index texture);

  /// The corners since the last face.
  std::span<const Index> corners() const { return std::span(mesh_.faces.vertices).subspan(first_corner_); }

  /// Takes the corners back.
  void drop_corners();

  /// Makes them a face. What is wrong with it, as an error message without its place; empty when nothing is.
  std::string finish_face();

  /// To be called once, last.
  void finish();

 private:
  std::string repeated_corner();

  Mesh& mesh_;
  std::uint64_t max_corners_;
  Index first_index_;
  std::size_t first_corner_ = 0;
  bool has_texture_ = false;
  std::vector<Index> sorted_corners_;  ///< scratch
};

}  // namespace pliant
