#pragma once
// A mesh as glTF draws it.
#include <array>
#include <vector>

#include "pliant/mesh/mesh.h"

namespace pliant {

/// Triangles, lines and the vertices that they refer to. A vertex with several texture coordinates is there once for
/// each; a mesh without them keeps its vertices as they are.
struct GltfSurface {
  explicit GltfSurface(const Mesh& mesh);

  std::vector<Index> vertices;                ///< that of the mesh for each of ours
  std::vector<std::array<float, 2>> texture;  ///< u and v for each of ours, v from the top; or empty
  std::vector<Index> triangles;               ///< three of ours for each
  std::vector<Index> lines;                   ///< two of ours for each
};

/// A surface with normals of its corners as glTF has them: a vertex for each normal that its corners have.
struct SplitCorners {
  SplitCorners(const Mesh& surface, const Positions& corner_normals);

  Positions positions;
  Positions normals;             ///< one for each of ours
  std::vector<Index> triangles;  ///< three of ours for each
};

/// The normal of each vertex, of length 1: the sum of the areas of its triangles as vectors. Where that is 0 it is +z.
Positions vertex_normals(const Mesh& mesh, const Positions& positions);

}  // namespace pliant
