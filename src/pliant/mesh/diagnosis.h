#pragma once
// Everything about a mesh that decides how well it simulates: sizes, what is connected, and each kind of defect.
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "pliant/mesh/geometry.h"
#include "pliant/mesh/mesh.h"

namespace pliant {

/// What a defect is a property of.
enum class DefectElement { vertex, edge, triangle, tetrahedron, polygon, facet };

/// What a defect does to a simulation. `refused`: check_mesh refuses the mesh. `harmful`: it simulates, but not as one
/// would expect. `harmless`: good to know.
enum class DefectEffect { refused, harmful, harmless };
constexpr std::array<std::string_view, 3> choice_names(DefectEffect) {
  return {"refused", "harmful", "harmless"};
}

/// Every kind of defect that is looked for.
enum class DefectKind {
  far_vertices,
  isolated_vertices,
  duplicate_vertices,
  nonmanifold_vertices,
  zero_length_edges,
  nonmanifold_edges,
  zero_area_triangles,
  duplicate_triangles,
  flipped_triangles,
  unorientable_sheets,
  zero_volume_tetrahedra,
  inverted_tetrahedra,
  bent_polygons,
  collapsed_facets,
};

struct DefectInfo {
  DefectKind kind;
  std::string_view name;  ///< in JSON
  std::string_view text;  ///< what there is so many of
  DefectElement element;
  DefectEffect effect;
  std::string_view meaning;  ///< for a simulation
  std::string_view remedy;
};
const DefectInfo& info_of(DefectKind kind);

/// One kind of defect of a mesh.
struct Defect {
  DefectKind kind;
  std::int64_t count = 0;  ///< > 0
  /// The lowest indices (of an edge, those of its two vertices), at most max_listed of them; none of facets, which the
  /// mesh does not have.
  std::vector<std::array<Index, 2>> first;

  static constexpr std::size_t max_listed = 10;
};

struct Spread {
  Real min = 0;
  Real mean = 0;
  Real max = 0;
};

/// A closed line of edges that have one triangle each.
struct BoundaryLoop {
  Index first_vertex = 0;  ///< its lowest
  Index vertex_count = 0;
  Real length = 0;  ///< [m]
};

struct Diagnosis {
  Index vertex_count = 0;
  Index edge_count = 0;          ///< of elements of every kind, each once
  Index edge_element_count = 0;  ///< elements that are only edges
  Index triangle_count = 0;
  Index tetrahedron_count = 0;
  Index polygon_count = 0;    ///< as the file has them
  Index largest_polygon = 0;  ///< its corners
  Index component_count = 0;  ///< parts that share no vertex, isolated vertices not counted

  bool is_measured = true;  ///< false with far vertices: then what follows is 0, lest it overflow
  BoundingBox box;
  Spread edge_length;    ///< of all edges [m]
  Spread triangle_area;  ///< [m²]
  Real area = 0;         ///< of the triangles; of tetrahedra without triangles, of their surface [m²]
  Real volume = 0;       ///< of the tetrahedra; without them, inside a closed, oriented surface, negative when the
                         ///< normals point inward [m³]

  bool is_closed = false;                    ///< triangles without boundary and non-manifold edges
  std::vector<BoundaryLoop> boundary_loops;  ///< by their first vertex
  std::vector<Defect> defects;               ///< in the order of DefectKind

  /// The defect of that kind, or null.
  const Defect* find(DefectKind kind) const;
};

/// Examines any mesh whose indices are in range, as every reader gives it; unlike check_mesh it refuses nothing. Takes
/// memory for one number a triangle corner beside the mesh; hand the mesh over by std::move where that matters.
Diagnosis diagnose(Mesh mesh);

}  // namespace pliant
