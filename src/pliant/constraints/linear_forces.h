#pragma once
// Forces of groups whose points are zero whatever z is, such as bending of what is flat at rest. With rows of A that
// sum to zero their energy is
//
//   E = k/2 Σᵢ wᵢ ‖Aᵢ Sᵢ q‖² = k/4 Σ_vu C_vu ‖q_u − q_v‖²,   C = −Σᵢ wᵢ Sᵢᵀ Aᵢᵀ Aᵢ Sᵢ,   f_v = k Σ_u C_vu (q_u − q_v),
//
// so that one product with a sparse matrix, known beforehand, takes the place of projecting each constraint and of
// collecting what they write (the isometric bending of Bergou et al. 2006, Eq. 3, where the constraints are hinges).
//
// What terms that cancel leave of rounding does not sum to zero, as the forces of each constraint do, and would set a
// stiff plate at rest in motion. So it is told where a whole group is at rest to rounding: its forces are none then.
#include "pliant/constraints/constraint_group.h"

namespace pliant {

class LinearForces {
 public:
  /// Rows of a group, one for each of its vertices.
  struct Rows {
    std::size_t begin = 0, end = 0;
    bool are_worth_it = false;  ///< they take less than its constraints, one by one
  };

  /// Adds rows for a group, in order of its vertices, unless they are not worth it.
  Rows add(const ConstraintGroup& group, Index vertex_count);
  /// The vertex of each row.
  std::span<const Index> vertices() const { return vertices_; }
  struct Found {
    Real energy = 0;          ///< [J], of the rows: a share, which need not be positive
    bool is_rounding = true;  ///< no force is larger than what rounding of the positions makes
  };
  /// Writes the forces of rows [begin, end) [N], three numbers each.
  Found run(Real stiffness, const Positions& q, std::size_t begin, std::size_t end, Real* forces) const;
  /// About k/4 Σ |C_vu| ‖q_u − q_v‖² [J], of what run() sums up the magnitude, for all rows of a group.
  Real magnitude(Real stiffness, const Positions& q, std::size_t begin, std::size_t end) const;
  std::size_t bytes() const;

 private:
  std::vector<Index> vertices_;
  std::vector<std::uint32_t> offsets_{0};
  std::vector<Index> columns_;
  std::vector<Real> values_;
  std::vector<Real> sizes_;  // Σ_u |C_vu| of each row
};

}  // namespace pliant
