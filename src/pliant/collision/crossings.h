#pragma once
// Where surfaces pass through each other or through themselves: edges against triangles, with exact signs. A check for
// meshes, scenes and tests; it shares no code with any method that keeps surfaces apart, so that it can judge them.
//
// What counts as a crossing. Take an edge and a triangle that share no vertex.
//   - The edge passes through the triangle's interior: a crossing.
//   - It meets an edge or a vertex of the triangle, at a point x of the edge's interior: a crossing if the triangles
//     around x separate its two ends. Two triangles at an edge do so if they lie on both sides of the plane of both
//     edges, the triangles around a vertex if they form a closed fan and the ends lie on different sides of the fan.
//   - The edge ends on the triangle, in a vertex x: a crossing if the triangles around x separate two neighbors of the
//     vertex. It is reported once, with the first edge at the vertex that leaves those triangles.
// So a mesh line that lies exactly on a mesh line of the other surface, or a vertex on a vertex, is a crossing where
// the surfaces pass through each other, and none where they only touch: a vertex that rests on a triangle, a seam of
// coincident vertices, stacked boxes, triangles that overlap in one plane. The border of a sheet separates nothing.
// Not reported are sheets that lie in one plane over an area and leave it to both sides, and those that meet in a
// vertex of both and pass through each other there only between their edges; where they go on, away from such places,
// they are.
//
// Judging the triangles around a point was chosen over a symbolic perturbation of the vertices (which has no singular
// cases either), since a perturbation makes a crossing of every second touch.
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "pliant/mesh/mesh.h"

namespace pliant {

/// An edge that passes through a triangle.
struct Crossing {
  Edge edge;                            ///< its vertices, smaller index first
  std::array<Index, 2> edge_triangles;  ///< the first two triangles with that edge, −1 for none
  Index triangle = -1;                  ///< what it passes through
  Vec3 point = Vec3::Zero();            ///< where, rounded to double precision [m]
};

/// Edges and triangles that are tried against each other. Surfaces of several bodies stand one after another.
struct CrossingInput {
  const Positions& positions;           ///< m × 3 [m]
  std::span<const Triangle> triangles;  ///< of vertices in range
  std::span<const Edge> edges{};  ///< that no triangle has, such as a rope's; those of triangles need not be given
  /// The search ends early past this effort: about 1 for two boxes that are compared, 32 for an edge and a triangle
  /// whose boxes meet. Ordinary meshes take 600 to 800 for a triangle; where all boxes meet, the effort grows as n².
  std::int64_t most_effort = std::numeric_limits<std::int64_t>::max();
};

/// Some seconds: enough for millions of ordinary triangles, not for 100,000 that all overlap.
constexpr std::int64_t usual_crossing_effort(std::size_t triangle_count) {
  return 1'000'000'000 + 2'000 * static_cast<std::int64_t>(triangle_count);
}

/// Calls `visit` with every crossing, each once, in an order that depends on the input alone. Left out are triangles
/// without any area, edges without length, and both where a coordinate is not finite or past coordinate_limit. A
/// triangle that is repeated is crossed as often, but once at its border.
///
/// The search halves the triangles along the longest side of their box, again and again, each half with the edges whose
/// boxes meet its own: about n log n for meshes whose triangles overlap in few boxes, and memory for O(n) in any case.
/// Single-threaded. Returns whether it came to its end, see CrossingInput::most_effort.
bool visit_crossings(const CrossingInput& input, const std::function<void(const Crossing&)>& visit);

struct Crossings {
  std::int64_t count = 0;       ///< all of them
  std::vector<Crossing> first;  ///< by edge, then triangle; the first ones
  bool is_complete = true;      ///< false if the search ended early
};

/// The crossings, of which at most `most` are listed.
Crossings find_crossings(const CrossingInput& input, std::size_t most = 10);

/// The triangles of a body's surface: those of the mesh; without any, the boundary of its tetrahedra.
std::vector<Triangle> surface_triangles(const Mesh& mesh);

}  // namespace pliant
