#include "render/render_mesh.h"

#include <algorithm>

#include "pliant/mesh/topology.h"
#include "render/hard_edges.h"

namespace pliant_render {
namespace {

template <class Element>
void append(std::vector<std::uint32_t>& list, std::span<const Element> elements, Index first_vertex) {
  for (const Element& element : elements) {
    for (const Index vertex : element) list.push_back(static_cast<std::uint32_t>(first_vertex + vertex));
  }
}

/// The row of texture coordinates at each corner of the triangles, which are cut from polygons in their order; -1 for
/// none, and no rows where the mesh has none.
std::vector<Index> texture_rows(const pliant::Mesh& mesh, const std::vector<pliant::Triangle>& triangles) {
  const pliant::PolygonFaces& faces = mesh.faces;
  std::vector<Index> rows;
  if (faces.texture_coordinates.empty() || mesh.texture_coordinates.rows() == 0) return rows;
  rows.assign(3 * triangles.size(), -1);
  std::size_t t = 0;
  for (std::size_t face = 1; face < faces.offsets.size(); ++face) {
    const auto first = static_cast<std::size_t>(faces.offsets[face - 1]);
    const auto end = static_cast<std::size_t>(faces.offsets[face]);
    for (std::size_t corner = first + 2; corner < end && t < triangles.size(); ++corner) {
      const std::array<std::size_t, 3> fan = {first, corner - 1, corner};
      const pliant::Triangle cut = {faces.vertices[fan[0]], faces.vertices[fan[1]], faces.vertices[fan[2]]};
      if (cut != triangles[t]) continue;
      for (std::size_t k = 0; k < 3; ++k) rows[3 * t + k] = faces.texture_coordinates[fan[k]];
      ++t;
    }
  }
  return rows;
}

/// Corners of one body after the other. Texture coordinates are put in order once all copies are known.
class CornerList {
 public:
  explicit CornerList(RenderMesh& render_mesh) : render_mesh_(render_mesh) {}

  void append(const pliant::Mesh& mesh, const pliant::Mesh& surface, Index first_vertex) {
    const std::vector<Index> rows = texture_rows(mesh, surface.triangles);
    const ShadedCorners shaded = split_at_hard_edges(surface.vertices, surface.triangles, rows);
    const auto count = static_cast<std::uint32_t>(surface.vertex_count());
    const auto next =
        static_cast<std::uint32_t>(render_mesh_.vertex_count) + static_cast<std::uint32_t>(render_mesh_.copies.size());
    const auto first = static_cast<std::uint32_t>(first_vertex);
    const auto of_all = [&](std::uint32_t number) { return number < count ? first + number : next + (number - count); };
    for (std::size_t corner = 0; corner < shaded.numbers.size(); ++corner) {
      render_mesh_.corners.push_back(of_all(shaded.numbers[corner]));
      if (rows.empty() || rows[corner] < 0) continue;
      coordinates_.emplace_back(render_mesh_.corners.back(),
                                mesh.texture_coordinates.row(rows[corner]).transpose().cast<float>());
    }
    for (const std::uint32_t vertex : shaded.copies) render_mesh_.copies.push_back(first + vertex);
    for (const std::uint32_t number : shaded.normals_from) render_mesh_.normals_from.push_back(of_all(number));
  }

  void finish() {
    if (coordinates_.empty()) return;
    const std::size_t count = static_cast<std::size_t>(render_mesh_.vertex_count) + render_mesh_.copies.size();
    render_mesh_.texture_coordinates.assign(count, Vec2f::Zero());
    for (const auto& [corner, place] : coordinates_) render_mesh_.texture_coordinates[corner] = place;
  }

 private:
  RenderMesh& render_mesh_;
  std::vector<std::pair<std::uint32_t, Vec2f>> coordinates_;
};

/// What is held counts for nothing, so that a body that is the only free one has the first tones.
std::vector<std::uint8_t> number_tones(const std::vector<pliant::Body>& bodies, std::span<const std::uint32_t> held,
                                       Index vertex_count) {
  std::vector<std::uint8_t> tones(static_cast<std::size_t>(vertex_count), 0);
  std::size_t number = 0;
  for (const pliant::Body& body : bodies) {
    const Index count = body.mesh.vertex_count();
    if (count == 0 || std::ranges::binary_search(held, static_cast<std::uint32_t>(body.first_vertex))) continue;
    std::fill_n(tones.begin() + body.first_vertex, count,
                static_cast<std::uint8_t>(number++ % pliant::body_tones.size()));
  }
  return tones;
}

}  // namespace

bool have_same_shape(const RenderMesh& a, const RenderMesh& b) {
  return a.vertex_count == b.vertex_count && a.triangles == b.triangles && a.corners == b.corners &&
         a.texture_coordinates == b.texture_coordinates && a.ropes == b.ropes && a.edges == b.edges &&
         a.springs == b.springs && a.rest_lengths == b.rest_lengths && a.bodies == b.bodies && a.tones == b.tones &&
         a.is_sheet == b.is_sheet;
}

RenderMesh make_render_mesh(const std::vector<pliant::Body>& bodies, std::span<const std::uint32_t> held) {
  RenderMesh render_mesh;
  for (const pliant::Body& body : bodies) {
    render_mesh.vertex_count = std::max(render_mesh.vertex_count, body.first_vertex + body.mesh.vertex_count());
  }
  render_mesh.is_sheet.resize(static_cast<std::size_t>(render_mesh.vertex_count), 0);
  render_mesh.bodies.resize(render_mesh.is_sheet.size(), 0);
  CornerList corners(render_mesh);
  for (std::size_t number = 0; number < bodies.size(); ++number) {
    const pliant::Body& body = bodies[number];
    const pliant::Mesh& mesh = body.mesh;
    std::fill_n(render_mesh.bodies.begin() + body.first_vertex, mesh.vertex_count(),
                static_cast<std::uint32_t>(number));
    pliant::Mesh surface;
    surface.vertices = mesh.vertices;
    surface.triangles = mesh.triangles;
    if (!mesh.tetrahedra.empty() && mesh.embedding.is_empty()) {
      const std::vector<pliant::Triangle> skin = pliant::boundary_triangles(mesh.tetrahedra);
      surface.triangles.insert(surface.triangles.end(), skin.begin(), skin.end());
    }
    append<pliant::Triangle>(render_mesh.triangles, surface.triangles, body.first_vertex);
    render_mesh.first_corners.push_back(static_cast<std::uint32_t>(render_mesh.corners.size()));
    corners.append(mesh, surface, body.first_vertex);
    append<pliant::Edge>(render_mesh.ropes, mesh.edges, body.first_vertex);
    append<pliant::Edge>(render_mesh.edges, pliant::unique_edges(surface), body.first_vertex);
    const bool is_sheet = mesh.tetrahedra.empty() && !mesh.triangles.empty();
    std::fill_n(render_mesh.is_sheet.begin() + body.first_vertex, mesh.vertex_count(), is_sheet ? 1 : 0);
    const std::vector<pliant::Edge> springs = pliant::unique_edges(mesh);
    append<pliant::Edge>(render_mesh.springs, springs, body.first_vertex);
    for (const pliant::Edge& edge : springs) {
      render_mesh.rest_lengths.push_back(
          static_cast<float>((mesh.vertices.row(edge[1]) - mesh.vertices.row(edge[0])).norm()));
    }
  }
  corners.finish();
  render_mesh.first_corners.push_back(static_cast<std::uint32_t>(render_mesh.corners.size()));
  render_mesh.tones = number_tones(bodies, held, render_mesh.vertex_count);
  return render_mesh;
}

void rest_at(RenderMesh& render_mesh, const pliant::Positions& positions) {
  for (std::size_t e = 0; e < render_mesh.rest_lengths.size(); ++e) {
    const auto a = static_cast<Index>(render_mesh.springs[2 * e]),
               b = static_cast<Index>(render_mesh.springs[2 * e + 1]);
    render_mesh.rest_lengths[e] = static_cast<float>((positions.row(a) - positions.row(b)).norm());
  }
}

std::vector<Vec3f> to_floats(const pliant::Positions& x) {
  std::vector<Vec3f> result(static_cast<std::size_t>(x.rows()));
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = x.row(static_cast<Eigen::Index>(i)).transpose().cast<float>();
  }
  return result;
}

Bounds bounds_of(std::span<const Vec3f> positions) {
  Bounds bounds;
  for (const Vec3f& p : positions) bounds.add(p);
  return bounds;
}

Bounds bounds_of(const FrameContent& frame) {
  Bounds bounds = bounds_of(std::span<const Vec3f>(frame.positions));
  for (const Vec3f& point : collider_points(frame.colliders, bounds)) bounds.add(point);
  return bounds;
}

Bounds bounds_of(const FrameContent& frame, const pliant::ViewSettings& appearance) {
  return appearance.colliders ? bounds_of(frame) : bounds_of(std::span<const Vec3f>(frame.positions));
}

FrameContent visible_part(FrameContent frame, const pliant::ViewSettings& appearance) {
  if (!appearance.colliders) frame.colliders.clear();
  return frame;
}

std::vector<Vec3f> corner_normals(const RenderMesh& render_mesh, std::span<const Vec3f> positions) {
  std::vector<Vec3f> normals(positions.size() + render_mesh.copies.size(), Vec3f::Zero());
  for (std::size_t t = 0; t + 2 < render_mesh.triangles.size(); t += 3) {
    const std::uint32_t a = render_mesh.triangles[t], b = render_mesh.triangles[t + 1],
                        c = render_mesh.triangles[t + 2];
    const Vec3f normal = (positions[b] - positions[a]).cross(positions[c] - positions[a]);
    for (std::size_t k = t; k < t + 3; ++k) normals[render_mesh.corners[k]] += normal;
  }
  const auto count = static_cast<std::uint32_t>(positions.size());
  for (std::size_t copy = 0; copy < render_mesh.copies.size(); ++copy) {
    const std::uint32_t from = render_mesh.normals_from[copy];
    if (from != count + copy) normals[from] += normals[count + copy];
  }
  for (Vec3f& normal : normals) {
    const float length = normal.norm();
    if (length > 0) normal /= length;
  }
  for (std::size_t copy = 0; copy < render_mesh.copies.size(); ++copy) {
    normals[count + copy] = normals[render_mesh.normals_from[copy]];
  }
  return normals;
}

}  // namespace pliant_render
