#pragma once
// Vertex colors, which a mesh keeps as the maps `red`, `green`, `blue` and, where they have an opacity, `alpha`.
#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "pliant/mesh/mesh.h"

namespace pliant {

inline constexpr std::array<std::string_view, 4> color_names = {"red", "green", "blue", "alpha"};

/// The colors of a file that has perhaps some.
class ColorColumns {
 public:
  /// The color of vertex v, three or four numbers, of at most `vertex_count` vertices. The first one brings the
  /// columns into being, where the others are white.
  void set(std::size_t v, std::span<const Real> color, std::size_t vertex_count) {
    for (std::size_t k = 0; k < color.size(); ++k) {
      if (columns_[k].empty()) columns_[k].assign(vertex_count, 1);
      columns_[k][v] = color[k];
    }
  }

  /// Hands the columns over to the mesh.
  void finish(Mesh& mesh) {
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (!columns_[k].empty()) mesh.maps.push_back({std::string(color_names[k]), std::move(columns_[k])});
    }
  }

 private:
  std::array<std::vector<Real>, 4> columns_;
};

/// The maps of a mesh that make its colors.
struct ColorMaps {
  std::array<const VertexMap*, 4> channels{};  ///< the first `count` are there
  std::size_t count = 0;                       ///< 0, 3 or 4
  bool are_bytes = false;                      ///< whole numbers up to 255, else 1 is full

  explicit ColorMaps(const Mesh& mesh);
};

}  // namespace pliant
