#pragma once
// The local step for many constraints of one type side by side, and the sums of what vertices get from them, for the
// instruction set of the processor at hand. A type names its kernel (`static constexpr auto kernel =
// &LocalKernels::edge_spring;`), and Batch does by itself, one after the other, what a kernel leaves: the end of a run
// that fills no whole vector, and the odd cases.
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace pliant {

/// How many constraints a call takes at most.
inline constexpr std::size_t local_block = 64;
/// So many constraints have their coefficients side by side (LaneCoefficients).
inline constexpr std::size_t lanes_of_coefficients = 8;

/// A run of constraints of one batch; all lists begin with its first.
struct LocalBlock {
  const double* positions;  ///< of all vertices, m × 3
  const std::int32_t* stencil;
  const double* reduction;     ///< of types whose batches have a number of vertices of their own; others do not read it
  const double* coefficients;  ///< of the others, side by side; differences read neither
  const double* fields;
  const double* measure;
  double stiffness;
  std::size_t vertices;  ///< of a constraint
  std::size_t count;
  double* out;  ///< w (p − z) of a type with one row; else the forces Aᵀ w (p − z) on the vertices, n × 3
};

struct LocalDone {
  std::size_t count = 0;   ///< constraints from the first on
  std::uint64_t left = 0;  ///< bit i: constraint i of these was left all the same, and its `out` may be anything
  double energy = 0;       ///< of those done

  /// The first constraint from i on that is not done; `count`, or any after it, where all the rest is.
  std::size_t next(std::size_t i) const {
    const std::uint64_t rest = i < local_block ? left >> i << i : 0;
    return rest == 0 ? (i < count ? count : i) : static_cast<std::size_t>(std::countr_zero(rest));
  }
};

/// Rows of a matrix C whose forces on vertex v are k Σ_u C_vu (q_u − q_v), and their energy k/4 Σ C_vu ‖q_u − q_v‖².
struct LinearRows {
  const double* positions;       ///< of all vertices, m × 3
  const std::int32_t* vertices;  ///< v of each row
  const std::uint32_t* offsets;  ///< row i has the entries [offsets[i], offsets[i + 1])
  const std::int32_t* columns;   ///< u of each entry
  const double* values;          ///< C_vu of each entry
  double stiffness;              ///< k
  std::size_t begin, end;        ///< the rows at hand
  double* forces;                ///< of row `begin` first, 3 numbers each
};

/// So many numbers are read, and not used, after the last of a list of slots or sums.
inline constexpr std::size_t read_after_last = 1;

/// The sums of a chunk: what each of its vertices gets from the slots of its constraints.
struct CollectedVertices {
  const double* slots;           ///< 3 numbers each, and read_after_last more
  const std::uint16_t* entries;  ///< twice the slot, plus one where the coefficient is −1
  const double* coefficients;    ///< of the entries; read by collect_any alone
  const std::uint32_t* ends;  ///< of each vertex's entries, which begin where those of the vertex before end, or at 0
  std::size_t count;          ///< vertices
  double* sums;               ///< of each vertex, 3 numbers
};

/// Vertices that get r ← Σ sums + w (s − q), or 0 where they are pinned.
struct GatheredVertices {
  const double* sums;           ///< of all chunks, 3 numbers each, and read_after_last more
  const std::size_t* offsets;   ///< vertex i has the places [offsets[i], offsets[i + 1])
  const std::uint32_t* places;  ///< of its sums
  const double* q;              ///< m × 3, as s and r
  const double* s;
  const double* weights;  ///< w of each vertex
  const char* is_pinned;
  double* r;
  std::size_t begin, end;  ///< the vertices at hand
};

struct GatheredSums {
  double squared_residual = 0;  ///< the largest ‖r‖²; NaN if one is
  double inertia = 0;           ///< Σ w/2 ‖s − q‖²
};

struct LocalKernels {
  using Kernel = LocalDone(const LocalBlock& block);
  Kernel* edge_spring;
  Kernel* edge_strain;
  Kernel* fibre_strain;
  Kernel* taut_fibre;
  Kernel* triangle_strain;     ///< with one stretch allowed; others are left
  Kernel* tetrahedron_strain;  ///< the same
  Kernel* triangle_area;       ///< far from its limits, inverted or nearly flat elements are left
  Kernel* tetrahedron_volume;  ///< the same
  Kernel* triangle_neo_hookean;
  Kernel* tetrahedron_neo_hookean;
  Kernel* triangle_stvk;
  Kernel* tetrahedron_stvk;
  Kernel* flat_curvature;
  Kernel* absolute_curvature;
  Kernel* signed_curvature;
  double (*linear_forces)(const LinearRows& rows);  ///< returns the energy
  using Collect = void(const CollectedVertices& vertices);
  Collect* collect_ones;   ///< all coefficients are 1
  Collect* collect_signs;  ///< 1 or −1
  Collect* collect_any;
  GatheredSums (*gather)(const GatheredVertices& vertices);
  const char* instruction_set;
};

/// All that this processor can run, the fastest last.
std::span<const LocalKernels* const> local_kernels();
const LocalKernels& fastest_kernels();

extern const LocalKernels portable_kernels;
extern const LocalKernels avx2_kernels;  // defined where the compiler has the instruction set
extern const LocalKernels avx512_kernels;

}  // namespace pliant
