#pragma once
// What a constraint type is to people, and what its builder gets and returns.
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "pliant/constraints/constraint_group.h"
#include "pliant/core/options.h"
#include "pliant/mesh/mesh.h"

namespace pliant {

/// One type of constraint, for people: the table of the README is made of these.
struct ConstraintInfo {
  std::string_view name;       ///< in scene files
  std::string_view reduction;  ///< z = A S q
  std::string_view set;        ///< the points p that satisfy the constraint, or no_set
  std::string_view energy;
  std::string_view source;
};

/// Of a type that does not project.
inline constexpr std::string_view no_set = "none: an energy of its own";

/// A body as the builders see it.
struct BodyView {
  const Mesh& rest;
  Positions start;     ///< where the vertices are when the constraint is added, m × 3 [m]
  Index first_vertex;  ///< of this body among all vertices of the simulation
  std::string_view name;
  Real time = 0;  ///< [s]
};

/// What a builder returns: one group for people, in batches for the solver (one for each valence, say).
struct ConstraintSet {
  std::vector<std::unique_ptr<ConstraintGroup>> batches;
  Index count = 0;             ///< constraints
  Index skipped = 0;           ///< places where the constraint is not defined
  std::string skipped_reason;  ///< which places, and how many of each
};

}  // namespace pliant
