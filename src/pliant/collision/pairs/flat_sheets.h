#pragma once
// Sheets that are flat at rest, and where they are spread out: neighbors there need not be searched for, as they cannot
// be near each other.
//
// Let f take a flat, convex domain to space, with the derivative F (3 × 2), the same all over a triangle. Let R be a
// matrix with orthonormal columns and λ no more than the least eigenvalue of (RᵀF + FᵀR)/2 anywhere on the straight way
// from y to x in the domain. Then, with z = x − y,
//
//     |z| |f(x) − f(y)| ≥ zᵀRᵀ(f(x) − f(y)) = ∫ zᵀRᵀF z dt ≥ λ |z|²,      so      |f(x) − f(y)| ≥ λ |x − y|.
//
// With A = F − R, RᵀF + FᵀR = 1 + FᵀF − AᵀA. So λ = (1 + c − ‖A‖²)/2 does, with c no more than an eigenvalue of FᵀF on
// any triangle around, and Frobenius' norm of the largest numbers of A there. The same is true all along a way on which
// all vertices go straight at the same time, if c and A have those of both ends: λ is concave along it.
//
// A sheet has a grid of cells of its flat shape, each with the least and the largest numbers of F on its triangles and
// the least c, and coarser grids above. R is nearest to the middle of these numbers. Where λ of a block of 4 × 4 cells,
// times the least distance that features without a common vertex have there at rest, is more than what is asked for, no
// two such features that lie in the block are nearer than that.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "pliant/collision/pairs/eight_boxes.h"
#include "pliant/collision/pairs/surface.h"
#include "pliant/core/thread_pool.h"

namespace pliant {

class FlatSheets {
 public:
  /// Where something lies in the flat shape of a sheet.
  struct Box {
    std::array<float, 2> low{}, high{};  ///< in cells of the finest grid
    Index sheet = -1;                    ///< none

    void add(const Box& other);
  };

  /// Finds the bodies that are sheets: one piece of triangles alone, whose rest shape (m × 3) [m], seen across their
  /// mean plane, is convex and has no triangle turned over. The surface must stay until the next call.
  void set_surface(const Surface& surface, const Positions& rest);
  bool is_empty() const { return sheets_.empty(); }
  /// Which sheet a vertex is of, −1 for none.
  Index sheet_of(Index vertex) const { return sheet_of_vertex_[at(vertex)]; }
  /// All vertices at rest, those of sheets in planes z = const that are `apart` from each other [m].
  Positions flattened(const Positions& rest, Real apart) const;
  /// Of each vertex, how near its features and those of its sheet that share no vertex with them are to each other,
  /// flattened, at least; or less than that.
  void set_nearest(std::span<const Real> nearest);

  /// Finds where sheets are spread out at q (m × 3) so that no such features are nearer than that [m]. What is not
  /// finite is not spread out. The same for any number of threads.
  void find_spread(const Positions& q, Real distance, ThreadPool& threads);
  /// The same on a way on which all vertices go straight at the same time.
  void find_spread(const Positions& begin, const Positions& end, Real distance, ThreadPool& threads);

  Box box_of(Index vertex) const;
  /// Whether all features in two boxes that share no vertex are farther apart than asked for. False where that is not
  /// known.
  bool are_apart(const Box& a, const Box& b) const {
    if (a.sheet < 0 || a.sheet != b.sheet) return false;
    const Sheet& sheet = sheets_[at(a.sheet)];
    const float column = std::min(a.low[0], b.low[0]), row = std::min(a.low[1], b.low[1]);
    const float size = std::max(std::max(a.high[0], b.high[0]) - column, std::max(a.high[1], b.high[1]) - row);
    // A rectangle of up to three cells lies in the block that begins with the cell of its corner.
    const Index level = size <= block - 1 ? 0 : rounded_up_logarithm(size / (block - 1));
    if (level >= sheet.level_count) return false;
    const Index cell = sheet.cell(level, static_cast<Index>(column) >> level, static_cast<Index>(row) >> level);
    return are_spread_[at(cell)] != 0;
  }

 private:
  static constexpr Index most_levels = 16;
  static constexpr Index block = 4;  // cells on a side
  static constexpr Index items_of_chunk = 512;

  struct Sheet {
    std::array<Real, 2> origin{};
    float cells_per_length = 0;              // [1/m]
    Index level_count = 0;                   // grids, each of cells twice as large as the one before
    std::array<Index, most_levels> begin{};  // of each, its first cell
    std::array<Index, most_levels> columns{};
    std::array<Index, most_levels> rows{};
    Index cell(Index level, Index column, Index row) const {
      return begin[at(level)] + row * columns[at(level)] + column;
    }
  };
  struct FlatTriangle {
    std::array<Index, 3> vertices;
    std::array<float, 4> inverse;  // of both edges from the first vertex, as columns [1/m]
  };
  /// Both columns, and behind the first one the least eigenvalue of FᵀF.
  struct Derivative {
    collision::FourFloats u, v;
  };
  static constexpr float no_end = std::numeric_limits<float>::infinity();
  static constexpr collision::FourFloats infinite{no_end, no_end, no_end, no_end};
  struct Hull {
    Derivative low{infinite, infinite}, high{-infinite, -infinite};
    void add(const Hull& other);
  };

  /// Of x ≥ 1 to the base of 2, from the bits of x.
  static Index rounded_up_logarithm(float x) {
    constexpr std::int32_t mantissa = (1 << 23) - 1, bias = 127;
    return ((std::bit_cast<std::int32_t>(x) + mantissa) >> 23) - bias;
  }
  void add_sheet(const Surface& surface, const Positions& rest, Index part, std::span<const Index> triangles,
                 std::span<const Index> vertices);
  static void lay_out_grids(std::span<const std::array<Real, 2>> places, Real size, Sheet& sheet);
  void lay_out_cells();
  /// Column and row in the finest grid, `further` cells further.
  static std::array<Index, 2> cell_at(const Sheet& sheet, const std::array<Real, 2>& place, Real further);
  static float least_of(std::span<const float> of_cells, const Sheet& sheet, Index level, Index column, Index row,
                        Index count);
  void find_hulls(const Positions& q, ThreadPool& threads);
  void judge(Real distance, ThreadPool& threads);
  static float least_eigenvalue(const Hull& hull);
  void judge(const Sheet& sheet, Index level, float distance, ThreadPool& threads);

  /// Calls visit(cell) for so many cells from there on, as far as the grid goes.
  template <class Visit>
  static void for_each_of(const Sheet& sheet, Index level, Index column, Index row, Index columns, Index rows,
                          Visit&& visit) {
    const Index last_column = std::min(column + columns, sheet.columns[at(level)]);
    const Index last_row = std::min(row + rows, sheet.rows[at(level)]);
    for (Index y = row; y < last_row; ++y) {
      for (Index x = column; x < last_column; ++x) visit(sheet.cell(level, x, y));
    }
  }
  template <class Visit>
  static void for_each_cell(const Sheet& sheet, Index level, Visit&& visit) {
    for (Index y = 0; y < sheet.rows[at(level)]; ++y) {
      for (Index x = 0; x < sheet.columns[at(level)]; ++x) visit(x, y);
    }
  }

  std::vector<Sheet> sheets_;
  std::vector<Index> sheet_of_vertex_;
  std::vector<std::array<Real, 2>> places_;  // of vertices of sheets in the flat shape [m]
  std::vector<FlatTriangle> triangles_;
  std::vector<Derivative> derivatives_;  // of triangles
  Index first_cells_ = 0;                // of the finest grids, which come first
  std::vector<Index> cell_begin_, cell_triangles_;
  std::vector<Hull> hulls_;         // of cells
  std::vector<Hull> side_by_side_;  // scratch, of blocks of one row
  std::vector<float> nearest_;      // of blocks that begin with a cell [m]
  std::vector<char> are_spread_;    // of the same
};

}  // namespace pliant
