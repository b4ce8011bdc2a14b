#pragma once
#include "pliant/core/options.h"
#include "pliant/mesh/mesh.h"

namespace pliant {

struct ChainOptions {
  static constexpr std::string_view shape = "chain";
  static constexpr std::string_view summary = "A line of edges that begins at the origin.";

  Index links = 10;          ///< edges, ≥ 1; vertices are one more
  Real length = 1;           ///< of the whole chain [m], > 0
  Vec3 direction{0, 0, -1};  ///< from the first vertex, at the origin; of any finite length but 0

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"links", "", "edges; vertices are one more", Range{1}}, self.links);
    field(OptionInfo{"length", "m", "of the whole chain", positive}, self.length);
    field(OptionInfo{"direction", "", "from the first vertex, at the origin; of any length but 0"}, self.direction);
  }
};

/// A straight line of edges: vertex i is i·length/links along the direction, edge i joins the vertices i and i + 1.
Mesh chain(const ChainOptions& options);

}  // namespace pliant
