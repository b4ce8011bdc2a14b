#pragma once
// What of the bodies is drawn: surfaces, ropes and edges. Made once; frames bring the positions.
#include <span>
#include <vector>

#include "pliant/simulation/simulation.h"
#include "render/camera.h"

namespace pliant_render {

using pliant::Index;

/// Lists of vertices as OpenGL takes them, with the indices of all bodies together.
struct Scenery {
  Index vertex_count = 0;
  std::vector<std::uint32_t> triangles;  ///< of sheets, and the surface of solids
  std::vector<std::uint32_t> ropes;      ///< elements that are only edges, two vertices each
  std::vector<std::uint32_t> edges;      ///< of the triangles, two vertices each, for the wireframe
  std::vector<std::uint32_t> springs;    ///< all edges, by which stretch is told, two vertices each
  std::vector<float> rest_lengths;       ///< of the springs [m]
};
Scenery make_scenery(const std::vector<pliant::Body>& bodies);

/// What changes from frame to frame.
struct FrameContent {
  std::vector<Vec3f> positions;        ///< one for each vertex [m]
  std::vector<float> values;           ///< of the vertices, for their colors; or none
  std::vector<std::uint32_t> markers;  ///< vertices with a red mark: those that are pinned, or under a test force
};

Bounds bounds_of(std::span<const Vec3f> positions);

/// Area-weighted means of the normals of the triangles at each vertex; zero where there are none.
std::vector<Vec3f> vertex_normals(const Scenery& scenery, std::span<const Vec3f> positions);

}  // namespace pliant_render
