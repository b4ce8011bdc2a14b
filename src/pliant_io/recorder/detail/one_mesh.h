#pragma once
// The bodies of a simulation as one mesh, for files that hold one.
#include <span>

#include "pliant/simulation/simulation.h"

namespace pliant {

/// The faces that a mesh shows: its polygons, else its triangles, else the surface of its tetrahedra.
PolygonFaces visible_faces(const Mesh& mesh);

/// Each polygon as a fan from its first corner.
std::vector<Triangle> cut_into_triangles(const PolygonFaces& faces);

/// A single body as it is; several as objects of one mesh, by their names, their vertices in the simulation's order,
/// without maps.
Mesh one_mesh(std::span<const Body> bodies);

/// The same for a folder that has none of the files beside the user's mesh: the materials' names stay, the libraries
/// that define them are not named.
Mesh one_mesh_of_run(std::span<const Body> bodies);

}  // namespace pliant
