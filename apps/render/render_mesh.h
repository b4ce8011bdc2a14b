#pragma once
// What is drawn of the bodies: surfaces, ropes and edges. Made once; frames bring the positions.
#include <map>
#include <span>
#include <string>
#include <vector>

#include "pliant/materials/material.h"
#include "pliant/simulation/simulation.h"
#include "pliant_io/scene/view_settings.h"
#include "render/camera.h"
#include "render/collider_view.h"

namespace pliant_render {

using pliant::Index;

/// Colors of a vertex whose body has an appearance of its own, as OpenGL takes them.
struct VertexLook {
  std::array<std::uint8_t, 4> front{};   ///< red, green, blue, and 255 where there is an appearance, else 0
  std::array<std::uint8_t, 4> back{};    ///< and the number of the pattern
  std::array<std::uint8_t, 4> second{};  ///< of the pattern, and the finish
  Vec3f place = Vec3f::Zero();           ///< in the pattern, in its fields; stripes go by x
  float threads = 0;                     ///< of the weave, along a unit of `place`; 0: none is shown
  float by_uv = 0;                       ///< above 0: `place` is that much times the texture coordinates

  bool operator==(const VertexLook&) const = default;
};
/// Numbers of patterns beside those of appearances. A gradient goes from the front's color on both sides to the back's
/// where `place` has -1 as its x, and to the second one where that is 1. A texture is on both sides, or with one more
/// on the front alone, and with two more it is by texture coordinates, whose unit square it fills.
inline constexpr std::uint8_t gradient_pattern = 3, texture_pattern = 4;
static_assert(choice_names(pliant::Pattern{}).size() == gradient_pattern);
/// What a body has where its appearance leaves colors open, by its place in the list.
const pliant::BodyTones& open_tones(std::size_t body);
/// What all bodies and colliders look like.
struct BodyLooks {
  std::vector<VertexLook> vertices;               ///< one per vertex; or none, where all look as usual
  std::map<std::uint32_t, std::string> textures;  ///< paths of files, by the places of bodies in the list
  ColliderLooks colliders;                        ///< of those that have one of their own

  bool operator==(const BodyLooks&) const = default;
};
/// By the bodies at rest. materials: of bodies that are made of one, which tells what their surface is like.
/// colliders: by name.
BodyLooks body_looks(const std::vector<pliant::Body>& bodies,
                     const std::map<pliant::BodyId, pliant::BodyAppearance>& appearances,
                     const std::map<pliant::BodyId, pliant::Material>& materials = {},
                     const std::map<std::string, pliant::ColliderAppearance, std::less<>>& colliders = {});

/// Index lists as OpenGL takes them, with vertices numbered through all bodies.
struct RenderMesh {
  Index vertex_count = 0;                ///< of all bodies
  std::vector<std::uint32_t> triangles;  ///< of sheets and of the surfaces of solids, three vertices each
  std::vector<std::uint32_t>
      corners;  ///< the same with copies of vertices at hard edges and seams of textures, numbered behind all vertices
  std::vector<std::uint32_t> copies;         ///< the vertex of each copy
  std::vector<std::uint32_t> normals_from;   ///< of each copy: the vertex or copy whose normal it has, or itself
  std::vector<Vec2f> texture_coordinates;    ///< one per vertex and copy, or none
  std::vector<std::uint32_t> first_corners;  ///< one per body, and the count of all: where its corners begin
  std::vector<std::uint32_t> ropes;          ///< edges that belong to no triangle or tetrahedron, two vertices each
  std::vector<std::uint32_t> edges;          ///< of the triangles, for the wireframe, two vertices each
  std::vector<std::uint32_t> springs;        ///< all edges, which define the stretch, two vertices each
  std::vector<float> rest_lengths;           ///< of the springs [m]
  std::vector<std::uint32_t> bodies;         ///< one per vertex: the place of its body in the list
  std::vector<std::uint8_t> tones;           ///< one per vertex: which of pliant::body_tones its body has
  BodyLooks looks;                           ///< what bodies look like
  std::vector<std::uint8_t> is_sheet;        ///< one per vertex: 1 where its body has triangles and no tetrahedra
};
/// Whether they differ in nothing but what bodies look like.
bool have_same_shape(const RenderMesh& a, const RenderMesh& b);
/// Free bodies have tones in turn. held: vertices of bodies that are held as a whole, as in FrameContent.
RenderMesh make_render_mesh(const std::vector<pliant::Body>& bodies, std::span<const std::uint32_t> held = {});

/// Takes the lengths that springs have at these positions as their rest lengths, as a recorded run's.
void rest_at(RenderMesh& render_mesh, const pliant::Positions& positions);
/// In single precision.
std::vector<Vec3f> to_floats(const pliant::Positions& x);

/// What changes from frame to frame.
struct FrameContent {
  std::vector<Vec3f> positions;        ///< one per vertex [m]
  std::vector<float> values;           ///< one per vertex, shown as colors; or empty
  std::vector<std::uint32_t> markers;  ///< vertices with a mark: pinned or under a test force
  std::vector<DrawnCollider> colliders{};
  std::vector<std::uint32_t> held{};  ///< vertices of bodies that are held as a whole: in the tone of colliders
};

Bounds bounds_of(std::span<const Vec3f> positions);
/// The box around bodies and colliders that the camera should see, see collider_points.
Bounds bounds_of(const FrameContent& frame);
/// The same of what these settings show.
Bounds bounds_of(const FrameContent& frame, const pliant::ViewSettings& appearance);
/// What these settings show of a frame: all, or all but its colliders.
FrameContent visible_part(FrameContent frame, const pliant::ViewSettings& appearance);

/// Area-weighted mean of the triangle normals at each vertex and each copy; zero where there are no triangles.
std::vector<Vec3f> corner_normals(const RenderMesh& render_mesh, std::span<const Vec3f> positions);

}  // namespace pliant_render
