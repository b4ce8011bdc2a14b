#pragma once
// Which triangles and which corners hang together across edges, and how the triangles are turned. Union-find.
#include <utility>
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// Triangles joined across edges, each turned like its sheet's first triangle or the other way.
class TurnedSheets {
 public:
  explicit TurnedSheets(std::size_t triangle_count);

  /// Two triangles at an edge: turned the same way when they run along it in opposite directions.
  void join(Index a, Index b, bool are_turned_alike);

  /// The lowest triangle of the sheet, and whether `triangle` is turned against it.
  std::pair<Index, bool> find(Index triangle);

  /// Whether going around in the sheet of that lowest triangle comes back turned.
  bool is_unorientable(Index lowest) const { return is_unorientable_[static_cast<std::size_t>(lowest)] != 0; }

 private:
  std::vector<Index> parent_;
  std::vector<char> is_turned_;  ///< against the parent
  std::vector<char> is_unorientable_;
};

/// Corners of triangles joined around their vertex: corner i of triangle t has number 3t + i.
class CornerFans {
 public:
  explicit CornerFans(std::size_t triangle_count);

  void join(std::size_t a, std::size_t b);

  /// Each fan has one corner that stands for it.
  bool is_first(std::size_t corner) const { return parent_[corner] == corner; }

 private:
  std::size_t find(std::size_t corner);

  std::vector<std::uint32_t> parent_;
};

}  // namespace pliant
