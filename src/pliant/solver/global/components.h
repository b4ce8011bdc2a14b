#pragma once
// The components of a simulation, which constraints connect, and those of them that nothing holds, which move freely as
// a whole.
#include "pliant/solver/global/system_matrix.h"

namespace pliant {

/// Their vertices, component after component, ascending in each; components in the order of their first vertices.
struct Components {
  std::vector<Index> vertices;
  std::vector<std::size_t> starts = {0};  ///< of each component in `vertices`, and the end of the last one

  bool operator==(const Components&) const = default;
  std::size_t count() const { return starts.size() - 1; }
  std::span<const Index> component(std::size_t i) const {
    return std::span(vertices).subspan(starts[i], starts[i + 1] - starts[i]);
  }
};

/// The component of each vertex.
std::vector<Index> component_of_vertex(const Components& components);

/// All components, as the matrix's pattern connects them.
Components find_components(const LowerMatrix& matrix);

/// Those of the components none of whose vertices belongs to a constraint that a translation does not leave as it is
/// (pins, drags, lines), or is pinned.
Components find_free_components(const Components& components, std::span<ConstraintGroup* const> groups,
                                std::span<const char> is_pinned);

/// The rigid motions that leave the constraints of a component as they are. None for one that a force acts on through
/// constraints, as the air does: they resist every motion.
enum class RigidFreedom : char { none, translations, all };

/// Of each free component.
std::vector<RigidFreedom> find_freedom(const Components& free, std::span<ConstraintGroup* const> groups);

}  // namespace pliant
