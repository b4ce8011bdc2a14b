#pragma once
// The triangular solve, forward and backward substitution, for the instruction set of the processor at hand.
#include <cstddef>
#include <cstdint>
#include <span>

namespace pliant {

/// Rows of a panel stand together in blocks of this many; x has as many lanes a row: three coordinates and a zero.
inline constexpr std::int32_t panel_lanes = 4;

/// One panel of the factor; panel_factor.h draws it.
struct Panel {
  std::int32_t first_column = 0;
  std::int32_t columns = 0;
  std::int32_t row_blocks = 0;  ///< of the rows below the diagonal block
  std::size_t first_row = 0;    ///< in the rows of all panels
  std::size_t first_value = 0;  ///< in the values of all panels
};

/// What a substitution reads, and x, four numbers a row, which it overwrites.
template <class T>
struct SubstitutionData {
  const Panel* panels;
  const std::int32_t* rows;
  const T* values;
  T* x;
};

/// A supernode of the factor L, of which a panel is made; see supernodes.h.
struct PanelSource {
  const double* values;  ///< by columns, each from its diagonal on or, in a rectangle, from the first row
  std::int32_t columns, rows_below;
  bool is_rectangle;
  double unit;  ///< a power of two
};

template <class T>
struct TriangularSolve {
  using Substitution = void (*)(const SubstitutionData<T>&, std::size_t begin, std::size_t end);

  Substitution forward;   ///< x ← S⁻¹ U⁻¹ x for the panels [begin, end), the first one first
  Substitution backward;  ///< x ← U⁻ᵀ x for them, the last one first
  /// Writes a panel as panel_factor.h draws it, (D Dᵀ)⁻¹ times unit² or D⁻¹ times `unit` first. `work`: room for as
  /// many numbers as panel_work() says.
  void (*write_panel)(const PanelSource& source, double* work, T* out);
  const char* instruction_set;
};

/// Columns of a panel that are written together.
inline constexpr std::int32_t panel_columns_together = 8;

/// What write_panel needs for a panel of n columns: n rows, padded, and up to 16 rows of the factor.
constexpr std::size_t panel_work(std::size_t columns) {
  constexpr std::size_t together = panel_columns_together;
  return columns * ((columns + together - 1) / together * together + 2 * together);
}

/// All of those that this processor can run, the fastest last. Always the same ones on the same machine.
template <class T>
std::span<const TriangularSolve<T>* const> all_triangular_solves();

template <class T>
const TriangularSolve<T>& fastest_triangular_solve() {
  return *all_triangular_solves<T>().back();
}

extern const TriangularSolve<float> portable_triangular_solve_single;
extern const TriangularSolve<double> portable_triangular_solve_double;
// Defined where the compiler has the instruction set.
extern const TriangularSolve<float> avx2_triangular_solve_single;
extern const TriangularSolve<double> avx2_triangular_solve_double;
extern const TriangularSolve<float> avx512_triangular_solve_single;
extern const TriangularSolve<double> avx512_triangular_solve_double;

}  // namespace pliant
