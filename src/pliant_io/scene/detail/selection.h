#pragma once
#include "pliant/core/options.h"
#include "pliant/mesh/mesh.h"
#include "pliant/mesh/nearest_vertex.h"
#include "pliant_io/scene/detail/json_node.h"

namespace pliant {

/// A body as selections and options see it.
struct SceneBody {
  const Mesh& mesh;                     ///< at rest, after the transform
  const Positions& untransformed;       ///< the same vertices before it [m]; of a solid its surface's
  std::optional<NearestVertex>& index;  ///< of mesh.vertices, made when it is first asked for

  const NearestVertex& places() const {
    if (!index) index.emplace(mesh.vertices);
    return *index;
  }
};

/// Reads which vertices are meant:
///     "all"                                every vertex
///     "boundary"                           boundary_vertices of topology.h
///     "corners"                            those at a corner of the bounding box before the transform
///     [0, 5, 6]                            by index
///     {"box": {"min": [..], "max": [..]}}  in the box, faces included
///     {"half_space": {"point": [..], "normal": [..]}}   on the normal's side of the plane, the plane included
///     {"nearest": [..]}                    the vertex nearest to the point, or to each point of a list
///     {"boundary_loop": 0}                 one line of the boundary, by its number in `pliant info`
///     {"boundary_loop": {"nearest": [..]}} the one that comes nearest to the point with a vertex
///     {"group": "sleeve"}                  of the faces in a group, an object or a material of the mesh's file
///     {"map": .., "above": a, "below": b}  where a map (read_map.h) is above a and below b; one of the two will do
///     {"any_of": [..]}, {"all_of": [..]}, {"not": ..}   of selections
/// Places are those of the rest positions after the transform; "included" is up to 1e-9 of the body's size.
/// Throws Error(input) on any other form, on an index out of range, and when no vertex is meant.
Selection read_selection(const Node& node, const SceneBody& body);

}  // namespace pliant
