#pragma once
// How much of each tetrahedron of a lattice is inside a surface.
#include <string_view>
#include <vector>

#include "pliant/mesh/closed_surface.h"
#include "pliant/mesh/detail/lattice_grid.h"

namespace pliant {

struct LatticeFilling {
  std::vector<Real> volumes;         ///< of each tetrahedron of the grid, inside [m³]
  std::vector<Real> vertex_volumes;  ///< of each vertex of the grid: ∫ of its barycentric weight over what is inside
  Real volume = 0;                   ///< of all that is inside, each place once
};

/// A tetrahedron that the surface meets is measured along lines an eighth of the side apart, or less where that is not
/// near enough to the volume that the surface encloses, and all of them are scaled to that; others are full or empty.
/// Throws Error(input) where walls are so thin that lines pass them by.
LatticeFilling fill_lattice(const LatticeGrid& grid, const Positions& x, const ClosedSurface& surface,
                            std::string_view name);

}  // namespace pliant
