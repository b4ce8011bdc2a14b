#pragma once
// What the system of equations of a simulation is like, for people.
#include <vector>

#include "pliant/solver/settings.h"

namespace pliant {

/// A connected component that nothing holds: no pin, drag or line, not even a soft one.
struct FreeComponent {
  Index first_vertex = 0;  ///< the lowest of its vertices
  Index vertex_count = 0;
  std::vector<Index> vertices{};  ///< all of them, in any order
};

struct SystemInfo {
  std::int64_t matrix_entries = 0;           ///< non-zeros of the lower triangle with the diagonal
  std::int64_t factor_entries = 0;           ///< values that its panels store, zeros among them
  std::int64_t supernodes = 0;               ///< panels of L
  std::int64_t substitution_bytes = 0;       ///< that the forward substitution of a solve reads of the factor
  std::int64_t backward_bytes = 0;           ///< that the backward substitution reads of it
  std::int64_t local_list_bytes = 0;         ///< of the lists by which chunks of constraints collect for vertices
  std::int64_t partial_bytes = 0;            ///< that chunks write for vertices, which these then read
  std::int64_t partial_list_bytes = 0;       ///< of the lists by which vertices read them
  std::int64_t bytes = 0;                    ///< that matrix and factor take
  Precision precision = Precision::double_;  ///< of the panels in use
  Real contraction = 0;       ///< of single precision: the share of an error that a solve leaves; 0 when not asked for
  Index pinned_vertices = 0;  ///< by hard pins; the others are free
  std::vector<FreeComponent> free_components;
  /// √λ_max(M⁻¹K) [rad/s], K the sum of the constraints' matrices on the free vertices: no vibration is faster. From
  /// below, to about 0.1 %.
  Real fastest_frequency = 0;
};

}  // namespace pliant
