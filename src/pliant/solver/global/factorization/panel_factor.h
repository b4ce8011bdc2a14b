#pragma once
// The Cholesky factor L as the triangular solves want it.
//
// A panel is a supernode, a run of columns that share their rows below the diagonal block:
//
//        c0 .. c0+nc
//       ┌──┐
//       │D ╲            (D Dᵀ)⁻¹: blocks of 4 rows, all columns. Of wide panels D⁻¹, block b up to column 4 b + 3
//       ├────┤
//       │ B  │  rows    B D⁻¹: blocks of 4 rows, all columns; row r belongs to row `rows[r]` of x
//       └────┘
//
// L Lᵀ = U S Uᵀ, where U has B D⁻¹ below identities and S has the blocks D Dᵀ. Forward substitution is x ← S⁻¹ U⁻¹ x,
// backward substitution x ← U⁻ᵀ x: what a panel takes from other rows, or they from it, does not wait for a product
// with its diagonal block, and the backward one does not read these at all.
//
// A block of rows stands column after column, so four values at a time; what a last block lacks is zeros. All three
// coordinates of a vertex, and a zero, go through a sweep together in four lanes, so each value is read once and serves
// three right-hand sides.
//
// Subtrees of the elimination tree (panel_tasks.h) are swept at the same time, in stages. What one of them subtracts
// from rows that are not its own goes to rows of x that it has for itself, and is added after its stage in the order of
// the subtrees: the bits do not depend on the number of threads.
#include "pliant/core/aligned.h"
#include "pliant/core/thread_pool.h"
#include "pliant/solver/global/factorization/panel_tasks.h"
#include "pliant/solver/global/factorization/supernodes.h"
#include "pliant/solver/global/factorization/triangular_solve.h"
#include "pliant/solver/state.h"

namespace pliant {

/// What becomes of the numbers that a solution is stored to.
enum class Store { over, onto };

/// Vectors in the order of the factor: that of column i is scale × numbers[4 i + axis].
template <class T>
struct InFactorOrder {
  std::span<T> numbers;
  Real scale;
};

/// Panels of `T`, float or double.
template <class T>
class PanelFactor {
 public:
  explicit PanelFactor(const TriangularSolve<T>& triangular_solve = fastest_triangular_solve<T>())
      : triangular_solve_(triangular_solve) {}
  PanelFactor(const PanelFactor&) = delete;
  PanelFactor& operator=(const PanelFactor&) = delete;

  /// Finds where everything goes; the values of the factor do not matter.
  void lay_out(const FactorView& factor);
  /// Takes over the values of a factor with the same supernodes. They are at most √largest_diagonal.
  void fill(const FactorView& factor, Real largest_diagonal, ThreadPool& threads);
  /// Gives all memory back.
  void clear();

  /// Solves L Lᵀ x = b in the order of the vertices (m × 3 each), or adds that x to what `x` holds. `scale`: about the
  /// largest number in b; the solution is zero where that is zero. Never allocates.
  SolveTimes solve(const Positions& b, Real scale, Positions& x, ThreadPool& threads, Store how = Store::over);
  /// Its two halves, for a scale above 0. In between y = S⁻¹ U⁻¹ b may be read, and another one written in its place.
  SolveTimes substitute_forward(const Positions& b, Real scale, ThreadPool& threads);
  InFactorOrder<T> between() { return {whole_x(), loaded_unit_ / (unit_ * unit_)}; }
  SolveTimes substitute_backward(Positions& x, ThreadPool& threads, Store how = Store::over);
  /// Forward substitution for a b that is mostly zero, in one thread: only panels that it reaches are read. Returns
  /// U⁻¹ b, which stands in `work`.
  InFactorOrder<T> substitute_forward_sparse(const Positions& b, Real scale, std::vector<T>& work);

  bool is_laid_out() const { return !panels_.empty(); }
  Index panel_count() const { return static_cast<Index>(panels_.size()); }
  Index stage_count() const { return static_cast<Index>(stages_.size()); }
  /// Of all stages.
  Index task_count() const;
  /// Stored values, the zeros that panels carry along included.
  std::size_t entry_count() const { return values_.size(); }
  /// What forward substitution reads besides x: values, rows and panels.
  std::size_t substitution_bytes() const {
    return sizeof(T) * values_.size() + sizeof(Index) * rows_.size() + sizeof(Panel) * panels_.size();
  }
  /// The same of backward substitution, which reads no diagonal blocks.
  std::size_t backward_bytes() const { return substitution_bytes() - sizeof(T) * diagonal_values_; }

 private:
  /// Panels that follow each other, and their columns.
  struct Part {
    std::size_t panel_begin = 0, panel_end = 0;
    std::size_t column_begin = 0, column_end = 0;
  };
  /// What is swept in one go. Rows of other tasks, of later stages or the rest, it has for itself.
  struct Task {
    std::vector<Part> parts;
    Index column_end = 0;                        // of its subtrees: rows below belong to others from here on
    std::size_t outer_begin = 0, outer_end = 0;  // in outer_rows_
    std::size_t own_rows = 0;                    // of x: one for each outer row, then one that counts nowhere
  };
  using Stage = std::vector<Task>;

  void lay_out_panels(const FactorView& factor);
  void lay_out_parts(const FactorView& factor);
  Part part_of(std::size_t begin, std::size_t end) const;
  std::vector<PanelShape> shapes_of(const FactorView& factor) const;
  template <class PlaceOf>
  void lay_out_rows(const FactorView& factor, const Part& part, Index nobodys, PlaceOf&& place_of);
  void lay_out_task_rows(const FactorView& factor, Task& task, std::size_t tasks_before,
                         std::vector<Index>& place_of_row);
  template <class Body>
  void for_each_task(const Stage& stage, ThreadPool& threads, Body&& body);
  void load(const Part& part, const Positions& b, Real factor);
  void store(const Part& part, Positions& x, Real factor, Store how) const;
  void forward(const Task& task);
  void forward_sparse(const Part& part, std::vector<T>& before);
  void clear_outer_rows(const Task& task);
  void add_outer_rows(const Task& task);
  void backward(const Task& task);
  std::span<T> whole_x() { return std::span<T>(x_).first(panel_lanes * permutation_.size()); }
  SubstitutionData<T> substitution_data() { return {panels_.data(), rows_.data(), values_.data(), x_.data()}; }

  const TriangularSolve<T>& triangular_solve_;
  std::vector<Index> permutation_;
  std::vector<Panel> panels_;
  std::vector<Index> rows_;  // of x, in blocks of four
  AlignedVector<T> values_;
  std::size_t diagonal_values_ = 0;  // of these, those of diagonal blocks
  Real unit_ = 1;                    // a power of two: S is stored as S / unit_²
  Real loaded_unit_ = 1;             // another: b is loaded as b / loaded_unit_
  std::vector<Stage> stages_;        // forward substitution takes one after the other
  std::vector<Part> rest_;           // runs of panels that belong to no task
  std::vector<Index> outer_rows_;    // of all tasks
  AlignedVector<T> x_;
};

}  // namespace pliant
