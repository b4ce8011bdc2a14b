#pragma once
// A surface may be drawn smoother than it is simulated. What a finer one has is found once; frames bring the positions.
#include <cstdint>
#include <span>
#include <vector>

#include "render/vectors.h"

namespace pliant_render {

/// A surface to be drawn smoother; it must outlive the call. Corners of triangles have numbers: that of their vertex,
/// or vertex_count + i for copy i of it, where the surface has a hard edge or a seam of its texture. A copy may have
/// the normal of a vertex or of an earlier copy.
struct CoarseSurface {
  std::uint32_t vertex_count = 0;
  std::span<const std::uint32_t> triangles;     ///< three vertices each
  std::span<const std::uint32_t> corners;       ///< three for each triangle: the number of each corner
  std::span<const std::uint32_t> copies;        ///< the vertex of each copy
  std::span<const std::uint32_t> normals_from;  ///< one per copy: the number whose normal it has, or its own
  std::span<const std::uint32_t> edges;         ///< of the wireframe, two vertices each
  std::span<const std::uint32_t> springs;       ///< two vertices each; those within solids are ignored
  std::span<const float> rest_lengths;          ///< of the springs [m]
};

/// Weighted sums, one a row: row i is the sum of weights[k] * coarse[sources[k]] for k from offsets[i] up to but not
/// including offsets[i + 1]. No row is empty, and the weights of each sum to 1.
struct Stencils {
  std::vector<std::uint32_t> offsets{0};  ///< one per row, and one more
  std::vector<std::uint32_t> sources;
  std::vector<float> weights;
};

/// The same surface with more triangles. Vertices keep their numbers; each later one lies on an edge, and the sources
/// of its row are in the same connected part of the surface.
struct FineSurface {
  std::uint32_t vertex_count = 0;
  std::vector<std::uint32_t> triangles;     ///< 4^levels in place of each
  std::vector<std::uint32_t> corners;       ///< as in CoarseSurface
  std::vector<std::uint32_t> copies;        ///< the coarse ones come first
  std::vector<std::uint32_t> normals_from;  ///< as in CoarseSurface
  std::vector<std::uint32_t> edges;         ///< 2^levels pieces of each; an edge of no triangle stays whole
  Stencils points;                          ///< one row per vertex, of vertices: where the smooth surface is
  Stencils places;                          ///< one row per number, of numbers: what is linear on coarse triangles
};

/// Cuts each triangle into four, `levels` times (0: as it is), with vertices where Loop's scheme has them ("Smooth
/// subdivision surfaces based on triangles", 1987), and keeps creases (Hoppe et al., "Piecewise smooth surface
/// reconstruction", 1994): borders, hard edges, and edges of three or more triangles.
///
/// An edge is hard where its two triangles have different normals, by `corners` and `normals_from`, at either end.
/// Vertices stay where they are if they are in no triangle, if more than two creases meet there, if triangles around
/// them do not all hang together by edges, if they have more than 256 neighbors, or if a border has a corner there: an
/// angle under 130 or above 230 degrees at rest, where the lengths of all edges are known. Triangles that name a vertex
/// twice smooth nothing; they become four that are as they were.
///
/// Takes time in proportion to what it returns.
FineSurface subdivide(const CoarseSurface& surface, int levels);

/// The rows of `stencils` for these values; `fine` gets one per row.
void apply_stencils(const Stencils& stencils, std::span<const float> coarse, std::vector<float>& fine);
void apply_stencils(const Stencils& stencils, std::span<const Vec2f> coarse, std::vector<Vec2f>& fine);
void apply_stencils(const Stencils& stencils, std::span<const Vec3f> coarse, std::vector<Vec3f>& fine);

}  // namespace pliant_render
