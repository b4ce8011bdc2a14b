#pragma once
// Solids from surfaces: a lattice of tetrahedra that covers the inside of any closed surface and carries it.
//
//     const Mesh solid = lattice_solid(torus({}), {.spacing = 0.05}, "ring");
//     const BodyId ring = simulation.add_body(solid, Mass::density(1000), {.name = "ring"});
//     simulation.add(ring, TetrahedronStrain{});
//     carry_surface(simulation, ring);   // carried_surface.h
//
// The lattice is body-centered cubic: its tetrahedra are all alike and as near to regular as those of a lattice are,
// and it is the same along all three axes. Tetrahedra that the surface cuts count by their share inside, in their
// weight and in their stiffness: the energy of a field that is linear in each tetrahedron is then that of the body, not
// of the lattice that sticks out of it.
#include <string_view>

#include "pliant/core/options.h"
#include "pliant/mesh/mesh.h"

namespace pliant {

struct LatticeOptions {
  /// Side of the lattice's cubes [m], > 0, at most the largest side of the body. Edges are as long, and √3/2 of it.
  /// Parts of a surface that are nearer to each other than that may have tetrahedra in common, and hang together then.
  Real spacing = 0.05;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"spacing", "m", "side of the cubes of the lattice that fills the surface", positive},
          self.spacing);
  }
};

/// More cubes than this in the box around a surface are refused.
inline constexpr Real max_lattice_cubes = 2e6;

/// No share of a tetrahedron inside counts as less.
inline constexpr Real least_filled_share = 0.01;

/// The surface with the lattice: its vertices in their order, then those of the lattice; its triangles, turned outward,
/// with its polygons; the tetrahedra that meet the inside or hold a vertex of the surface, in the order of the lattice;
/// and Mesh::embedding. Maps have at a vertex of the lattice the value of the nearest one of the surface. The volumes
/// of vertices share out what the surface encloses: that of the lattice by the weights of the places inside, so that
/// the center of mass is the body's, and of a layer of an eighth of the spacing to the surface's own vertices, so that
/// they have inertia where they touch something.
///
/// `name` is what messages call the mesh. Throws Error(input) as closed_surface does, and on a spacing out of range,
/// one that asks for more than max_lattice_cubes, walls that are too thin for it.
/// @pre check_mesh(surface).
Mesh lattice_solid(Mesh surface, const LatticeOptions& options, std::string_view name);

/// Share of the tetrahedra of such a mesh that is inside.
Real filled_share(const Mesh& mesh);

}  // namespace pliant
