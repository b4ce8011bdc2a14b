#pragma once
// What is said of surfaces that pass through each other or through themselves.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pliant/collision/crossings.h"
#include "pliant/simulation/simulation.h"

namespace pliant_cli {

/// Whose elements are named: a body among the triangles that crossings were looked for in, or a mesh by itself.
struct CrossingBody {
  std::string name{};                ///< of a mesh by itself ""
  pliant::Index first_vertex = 0;    ///< subtracted from vertices
  pliant::Index first_triangle = 0;  ///< subtracted from triangles
  bool is_solid = false;             ///< its triangles are faces of tetrahedra, which have no number
};

/// Whether the triangles may be those of a surface, which has about two for a vertex. Of more than sixteen the memory
/// of a search would not be in proportion to the mesh.
constexpr bool may_be_surface(std::size_t triangle_count, pliant::Index vertex_count) {
  return triangle_count <= 16 * static_cast<std::size_t>(vertex_count);
}

inline constexpr std::string_view incomplete_search = "looked for in part: too many triangles overlap";

/// The element of each side of a crossing, say "triangle 17" or, of a solid, "edge 3-17", and the triangle or "face
/// 5-6-7" that it passes through.
std::string edge_side_text(const CrossingBody& body, const pliant::Crossing& crossing);
std::string triangle_side_text(const CrossingBody& body, const pliant::Crossing& crossing,
                               std::span<const pliant::Triangle> triangles);

/// Both of one body: "triangles 17 and 402".
std::string both_sides_text(const CrossingBody& body, const pliant::Crossing& crossing,
                            std::span<const pliant::Triangle> triangles);

/// "(0.5, 0.25, 1) m"
std::string place_text(const pliant::Vec3& point);

/// Of a count that starts with the one that was named: "" or " (and 36 more)".
std::string more_text(std::int64_t count);

/// A line for each body that crosses itself and each pair of bodies that cross, where they stand now; at most five, and
/// then one with the number of the others. Where surfaces touch, ropes count, and what is told to ignore each other
/// does not.
std::vector<std::string> crossing_warnings(const pliant::Simulation& simulation);

}  // namespace pliant_cli
