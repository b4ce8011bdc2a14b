#pragma once
// What hangs together, and how the triangles of a surface are turned. Union-find.
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
  bool is_unorientable(Index lowest) const { return (marks_[static_cast<std::size_t>(lowest)] & unorientable) != 0; }

 private:
  static constexpr unsigned char turned = 1;
  static constexpr unsigned char unorientable = 2;

  std::vector<Index> parent_;
  std::vector<unsigned char> marks_;  ///< of a triangle: turned against its parent; of a lowest one: unorientable
};

/// Things that are joined to parts.
class Parts {
 public:
  explicit Parts(std::size_t count);

  void join(Index a, Index b);

  /// Each part has one thing that stands for it.
  bool is_first(Index thing) const { return parent_[static_cast<std::size_t>(thing)] == thing; }

 private:
  Index find(Index thing);

  std::vector<Index> parent_;
};

}  // namespace pliant
