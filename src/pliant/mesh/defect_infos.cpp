// What each kind of defect means for a simulation, and the remedy.
#include "pliant/mesh/diagnosis.h"

namespace pliant {

namespace {

using enum DefectElement;
using enum DefectEffect;

/// In the order of DefectKind.
constexpr std::array<DefectInfo, 14> infos{{
    {DefectKind::far_vertices, "far_vertices", "vertices past 1e100 m", vertex, refused,
     "areas and volumes there overflow", "import with a smaller scale, or fix the coordinates"},
    {DefectKind::isolated_vertices, "isolated_vertices", "vertices without an element", vertex, harmful,
     "they fall freely, and a density gives them no mass, which is refused", "remove them, or give each vertex a mass"},
    {DefectKind::duplicate_vertices, "duplicate_vertices", "vertices in the place of another", vertex, harmful,
     "nothing holds the two together, so a seam between parts opens", "merge vertices by distance, unless meant"},
    {DefectKind::nonmanifold_vertices, "nonmanifold_vertices", "vertices where surfaces meet in one point", vertex,
     harmless, "they get no bending", "split them, or live with a soft spot"},
    {DefectKind::zero_length_edges, "zero_length_edges", "edges without length", edge, refused,
     "a spring along them has no direction", "merge their ends, or move them apart"},
    {DefectKind::nonmanifold_edges, "nonmanifold_edges", "edges with more than two triangles", edge, harmless,
     "they get no bending; springs and strain do not mind", "split the surfaces, or live with a hinge"},
    {DefectKind::zero_area_triangles, "zero_area_triangles", "triangles without area", triangle, refused,
     "their strain is not defined", "dissolve degenerate faces, or move a vertex off the line"},
    {DefectKind::duplicate_triangles, "duplicate_triangles", "triangles on the vertices of another", triangle, harmful,
     "they count twice, in stiffness and in mass, and get no bending", "remove them"},
    {DefectKind::flipped_triangles, "flipped_triangles", "triangles turned against their neighbors", triangle, harmful,
     "their normals point to the other side, for wind, for shading and for volumes", "recalculate the normals"},
    {DefectKind::unorientable_sheets, "unorientable_sheets", "one-sided surfaces, like a Moebius strip", triangle,
     harmless, "they have no inside; all but volumes simulate", "none is needed, unless one glued edge is turned"},
    {DefectKind::zero_volume_tetrahedra, "zero_volume_tetrahedra", "tetrahedra without volume", tetrahedron, refused,
     "their strain is not defined", "improve the mesh, or remove them"},
    {DefectKind::inverted_tetrahedra, "inverted_tetrahedra", "tetrahedra turned inside out", tetrahedron, refused,
     "their rest shape cannot be met", "swap two vertices of each"},
    {DefectKind::bent_polygons, "bent_polygons", "polygons that are not flat", polygon, harmless,
     "they are cut as a fan from their first corner, which may not be the cut that you see",
     "triangulate them yourself"},
    {DefectKind::collapsed_facets, "collapsed_facets", "facets left out, two corners being one point", facet, harmless,
     "they had no area; where they were slivers, their neighbors still meet", "none is needed"},
}};

constexpr bool is_in_order() {
  for (std::size_t i = 0; i < infos.size(); ++i) {
    if (static_cast<std::size_t>(infos[i].kind) != i) return false;
  }
  return true;
}
static_assert(is_in_order());

}  // namespace

const DefectInfo& info_of(DefectKind kind) {
  return infos[static_cast<std::size_t>(kind)];
}

}  // namespace pliant
