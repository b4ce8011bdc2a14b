#pragma once
// The parts of a simulation that constraints connect, and those of them that nothing holds, which move freely as a
// whole.
#include "pliant/solver/global/system_matrix.h"

namespace pliant {

/// Their vertices, part after part, ascending in each; parts in the order of their first vertices.
struct ConnectedParts {
  std::vector<Index> vertices;
  std::vector<std::size_t> starts = {0};  ///< of each part in `vertices`, and the end of the last one

  std::size_t count() const { return starts.size() - 1; }
  std::span<const Index> part(std::size_t i) const {
    return std::span(vertices).subspan(starts[i], starts[i + 1] - starts[i]);
  }
};

/// All parts, as the matrix's pattern connects them.
ConnectedParts find_parts(const LowerMatrix& matrix);

/// Those of the parts none of whose vertices belongs to a constraint that a translation does not leave as it is (pins,
/// drags, lines), or is held exactly.
ConnectedParts find_free_parts(const ConnectedParts& parts, std::span<ConstraintGroup* const> groups,
                               std::span<const char> is_pinned);

}  // namespace pliant
