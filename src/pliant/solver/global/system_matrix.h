#pragma once
// Y = M/h² + Σ_g k_g L_g, m × m, for all three coordinates at once (thesis Eq. 3.10 and Sec. 4.2).
//
// Each group keeps its matrix at unit stiffness, L_g = Σ measureᵢ SᵢᵀAᵢᵀAᵢSᵢ, on the union of all patterns. A changed
// stiffness or time step sums them anew: no entry is ever subtracted, and the pattern, hence the symbolic analysis,
// stays. Pinned vertices keep their rows and columns in the pattern, emptied but for the diagonal, so that pinning and
// releasing costs a numeric factorization alone.
#include "pliant/constraints/constraint_group.h"

namespace pliant {

/// The lower triangle of a symmetric matrix by columns; every column begins with its diagonal entry, rows ascend.
struct LowerMatrix {
  std::vector<Index> column_starts = {0};
  std::vector<Index> rows;
  std::vector<Real> values;

  Index size() const { return static_cast<Index>(column_starts.size()) - 1; }
};

/// Calls visit(row, column, place) for every entry of the lower triangle, column after column.
template <class Visit>
void for_each_entry(const LowerMatrix& matrix, Visit&& visit) {
  for (Index column = 0; column < matrix.size(); ++column) {
    const std::size_t end = at(matrix.column_starts[at(column) + 1]);
    for (std::size_t e = at(matrix.column_starts[at(column)]); e < end; ++e) visit(matrix.rows[e], column, e);
  }
}

class SystemMatrix {
 public:
  /// Finds the union pattern and the unit matrices; those of groups with the same revision as before stay, and so does
  /// the pattern where it would be the same. After an error nothing does. Returns whether it is another. Throws
  /// Error(input) past 2³¹ − 1 entries.
  bool set_groups(Index vertex_count, std::span<const ConstraintGroup* const> groups);

  /// Sums the matrix for these masses [kg], this time step [s] and the groups' stiffnesses.
  void assemble(std::span<const Real> masses, Real time_step, std::span<const ConstraintGroup* const> groups,
                std::span<const char> is_pinned);

  /// Adds D, a number for each vertex [N/m], until the next assemble().
  void add_diagonal(std::span<const Real> diagonal);
  /// Writes the diagonal [N/m].
  void copy_diagonal(std::vector<Real>& diagonal) const;

  const LowerMatrix& matrix() const { return matrix_; }

 private:
  /// Entries of L_g: values at places of the union pattern.
  struct UnitMatrix {
    std::uint64_t revision = 0;  // of the group
    std::vector<Index> places;
    std::vector<Real> values;
  };
  /// A place is no entry.
  static constexpr Index none = -1;

  static LowerMatrix find_pattern(Index vertex_count, std::span<const ConstraintGroup* const> groups);
  void find_units(std::span<const ConstraintGroup* const> groups, std::span<UnitMatrix> units) const;
  bool has_pairs_of(const ConstraintGroup& group) const;
  bool is_all_used(std::span<const UnitMatrix> units) const;
  void move_units(std::span<UnitMatrix> units, const LowerMatrix& before) const;
  UnitMatrix unit_matrix(const ConstraintGroup& group, std::vector<Real>& sums, std::vector<char>& touched) const;
  Index place(Index row, Index column) const;

  LowerMatrix matrix_;
  std::vector<UnitMatrix> units_;
};

}  // namespace pliant
