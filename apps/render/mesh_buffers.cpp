#include "render/mesh_buffers.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <set>
#include <utility>

#include "pliant/core/error.h"
#include "render/texture_image.h"

namespace pliant_render {
namespace {

GLsizei size_of(const std::vector<std::uint32_t>& list) {
  return static_cast<GLsizei>(list.size());
}

const void* offset_of(std::size_t bytes) {
  return reinterpret_cast<const void*>(bytes);  // NOLINT: as OpenGL wants it
}

void point_at(GLuint place, GLint size, GLenum type, std::size_t stride, std::size_t offset) {
  glEnableVertexAttribArray(place);
  glVertexAttribPointer(place, size, type, type == GL_FLOAT ? GL_FALSE : GL_TRUE, static_cast<GLsizei>(stride),
                        offset_of(offset));
}

/// Repeated to all sides, and smoothed where it is drawn small. What is transparent has no color of its own that could
/// be seen at its edges: shares are multiplied by opacity.
void fill(const Texture& texture, TextureImage image) {
  for (std::size_t i = 0; i + 3 < image.pixels.size(); i += 4) {
    const int opacity = image.pixels[i + 3];
    if (opacity == 255) continue;
    for (std::size_t k = i; k < i + 3; ++k) {
      image.pixels[k] = static_cast<std::uint8_t>((image.pixels[k] * opacity + 127) / 255);
    }
  }
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               image.pixels.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
}

/// What a program needs for a vertex of this look.
SurfaceTraits traits_of(const VertexLook& look) {
  const int pattern = look.back[3], finish = look.second[3];
  SurfaceTraits traits;
  traits.has_looks = look.front[3] != 0;
  traits.has_gradient = traits.has_looks && pattern == gradient_pattern;
  traits.has_picture = traits.has_looks && pattern >= texture_pattern;
  traits.has_fields = traits.has_looks && pattern > 0 && pattern < gradient_pattern;
  traits.has_weave = look.threads > 0;
  traits.has_cloth = finish == static_cast<int>(pliant::Finish::cloth);
  traits.has_gloss = finish > static_cast<int>(pliant::Finish::matte);
  return traits;
}

/// The lists of a finer surface, without what frames are measured by.
RenderMesh mesh_of(const FineSurface& fine, const RenderMesh& coarse, int levels) {
  RenderMesh mesh;
  mesh.vertex_count = static_cast<Index>(fine.vertex_count);
  mesh.triangles = fine.triangles;
  mesh.corners = fine.corners;
  mesh.copies = fine.copies;
  mesh.normals_from = fine.normals_from;
  mesh.edges = fine.edges;
  mesh.ropes = coarse.ropes;
  for (const std::uint32_t first : coarse.first_corners) mesh.first_corners.push_back(first << (2 * levels));
  return mesh;
}

}  // namespace

MeshBuffers::MeshBuffers(RenderMesh render_mesh) : render_mesh_(std::move(render_mesh)) {
  fill(no_texture_, {1, 1, {0, 0, 0, 0}});
  upload_lists();
  read_textures();
  upload_looks();
}

void MeshBuffers::set_layout() const {
  glBindBuffer(GL_ARRAY_BUFFER, vertex_buffer_.id());
  point_at(0, 3, GL_FLOAT, sizeof(Vertex), offsetof(Vertex, position));
  point_at(1, 3, GL_FLOAT, sizeof(Vertex), offsetof(Vertex, normal));
  point_at(2, 1, GL_FLOAT, sizeof(Vertex), offsetof(Vertex, value));
  glBindBuffer(GL_ARRAY_BUFFER, looks_.id());
  point_at(3, 4, GL_UNSIGNED_BYTE, sizeof(VertexLook), offsetof(VertexLook, front));
  point_at(4, 4, GL_UNSIGNED_BYTE, sizeof(VertexLook), offsetof(VertexLook, back));
  point_at(5, 4, GL_UNSIGNED_BYTE, sizeof(VertexLook), offsetof(VertexLook, second));
  point_at(6, 3, GL_FLOAT, sizeof(VertexLook), offsetof(VertexLook, place));
  point_at(7, 1, GL_FLOAT, sizeof(VertexLook), offsetof(VertexLook, threads));
}

void MeshBuffers::set_up(const VertexArray& array, const Buffer& elements,
                         const std::vector<std::uint32_t>& list) const {
  glBindVertexArray(array.id());
  set_layout();
  upload(elements, GL_ELEMENT_ARRAY_BUFFER, list, GL_STATIC_DRAW);
  glBindVertexArray(0);
}

void MeshBuffers::upload_lists() {
  set_up(triangles_array_, triangles_, drawn().corners);
  set_up(ropes_array_, ropes_, drawn().ropes);
  set_up(edges_array_, edges_, drawn().edges);
}

void MeshBuffers::set_looks(BodyLooks looks) {
  render_mesh_.looks = std::move(looks);
  upload_looks();
  read_textures();
}

void MeshBuffers::read_textures() {
  std::set<std::string> used;
  for (const auto& [body, path] : render_mesh_.looks.textures) used.insert(path);
  std::erase_if(textures_, [&](const auto& texture) { return !used.contains(texture.first); });
  texture_error_.clear();
  for (const std::string& path : used) {
    std::error_code ignored;
    const auto time = std::filesystem::last_write_time(path, ignored);
    KnownTexture& known = textures_[path];
    if (known.is_read && known.time == time) continue;
    known = {.time = time, .is_read = true};
    try {
      TextureImage image = read_texture(path);
      known.texture = std::make_unique<Texture>();
      fill(*known.texture, std::move(image));
    } catch (const pliant::Error& error) {
      if (texture_error_.empty()) texture_error_ = error.what();
    }
  }
}

/// Copies look like their vertices, but for the places that they have in textures; those between others as the first of
/// these. Where nothing is said of the surface sheets have the sheen of cloth.
void MeshBuffers::upload_looks() {
  std::vector<VertexLook> looks = render_mesh_.looks.vertices;
  looks.resize(static_cast<std::size_t>(render_mesh_.vertex_count));
  for (std::size_t i = 0; i < looks.size(); ++i) {
    if (looks[i].second[3] != 0) continue;
    const auto usual = render_mesh_.is_sheet[i] != 0 ? pliant::Finish::cloth : pliant::Finish::matte;
    looks[i].second[3] = static_cast<std::uint8_t>(usual);
  }
  for (const std::uint32_t vertex : render_mesh_.copies) looks.push_back(looks[vertex]);
  for (std::size_t i = 0; i < render_mesh_.texture_coordinates.size(); ++i) {
    if (looks[i].by_uv > 0) looks[i].place.head<2>() = looks[i].by_uv * render_mesh_.texture_coordinates[i];
  }
  find_traits(looks);
  if (levels_ > 0) looks = fine_looks(looks);
  upload(looks_, GL_ARRAY_BUFFER, looks, GL_STATIC_DRAW);
}

/// What lies by the body at rest moves with the smooth surface, or straight stripes would be jagged: the scheme shifts
/// vertices within a flat mesh too. Texture coordinates are linear, since they differ at seams.
std::vector<VertexLook> MeshBuffers::fine_looks(const std::vector<VertexLook>& coarse) const {
  std::vector<Vec3f> places, linear_places, smooth_places;
  for (const VertexLook& look : coarse) places.push_back(look.place);
  apply_stencils(fine_.places, places, linear_places);
  apply_stencils(fine_.points, places, smooth_places);
  std::vector<VertexLook> fine(linear_places.size());
  for (std::size_t i = 0; i < fine.size(); ++i) {
    const std::size_t vertex = i < fine_.vertex_count ? i : fine_.copies[i - fine_.vertex_count];
    fine[i] = coarse[fine_.places.sources[fine_.places.offsets[i]]];
    fine[i].place = fine[i].by_uv > 0 ? linear_places[i] : smooth_places[vertex];
  }
  return fine;
}

bool MeshBuffers::set_subdivision(int levels) {
  constexpr std::size_t most_triangles = 4'000'000;
  while (levels > 0 && (render_mesh_.triangles.size() / 3) << (2 * levels) > most_triangles) --levels;
  if (levels == levels_) return false;
  FineSurface fine;
  if (levels > 0) {
    fine = subdivide({static_cast<std::uint32_t>(render_mesh_.vertex_count), render_mesh_.triangles,
                      render_mesh_.corners, render_mesh_.copies, render_mesh_.normals_from, render_mesh_.edges,
                      render_mesh_.springs, render_mesh_.rest_lengths},
                     levels);
  }
  levels_ = levels;
  fine_ = std::move(fine);
  fine_mesh_ = levels > 0 ? mesh_of(fine_, render_mesh_, levels) : RenderMesh();
  upload_lists();
  upload_looks();
  return true;
}

void MeshBuffers::set_frame(const FrameContent& frame, bool has_values) {
  std::vector<float>& values = levels_ > 0 ? coarse_values_ : values_;
  values.assign(render_mesh_.tones.begin(), render_mesh_.tones.end());
  if (has_values) {
    values = frame.values;
  } else {
    for (const std::uint32_t vertex : frame.held) values[vertex] = -1;
  }
  if (levels_ == 0) {
    positions_ = frame.positions;
  } else {
    apply_stencils(fine_.points, frame.positions, positions_);
    if (has_values) apply_stencils(fine_.points, values, values_);
    if (!has_values) values_.resize(positions_.size());
    for (std::size_t i = 0; !has_values && i < positions_.size(); ++i) {
      values_[i] = values[fine_.points.sources[fine_.points.offsets[i]]];
    }
  }
  const std::vector<Vec3f> normals = corner_normals(drawn(), positions_);
  vertices_.resize(normals.size());
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const std::size_t vertex = i < positions_.size() ? i : drawn().copies[i - positions_.size()];
    vertices_[i] = {positions_[vertex], normals[i], values_[vertex]};
  }
  upload(vertex_buffer_, GL_ARRAY_BUFFER, vertices_, GL_STREAM_DRAW);
}

void MeshBuffers::draw_triangles() const {
  glBindVertexArray(triangles_array_.id());
  glDrawElements(GL_TRIANGLES, size_of(drawn().corners), GL_UNSIGNED_INT, nullptr);
}

/// Of the surfaces of bodies; without copies, which look like their vertices.
void MeshBuffers::find_traits(const std::vector<VertexLook>& looks) {
  const std::size_t bodies = render_mesh_.first_corners.size();
  traits_.assign(bodies > 0 ? bodies - 1 : 0, {});
  const auto count = static_cast<std::size_t>(render_mesh_.vertex_count);
  for (std::size_t i = 0; i < std::min(count, render_mesh_.bodies.size()); ++i) {
    if (render_mesh_.bodies[i] >= traits_.size()) continue;
    SurfaceTraits& traits = traits_[render_mesh_.bodies[i]].traits;
    traits = traits.with(traits_of(looks[i]));
  }
  for (std::size_t i = 0; i < render_mesh_.rest_lengths.size(); ++i) {
    const std::uint32_t a = render_mesh_.springs[2 * i], b = render_mesh_.springs[2 * i + 1];
    const float length = render_mesh_.rest_lengths[i];
    if (render_mesh_.bodies[a] >= traits_.size() || !(length > 0) || !(looks[a].threads > 0)) continue;
    BodyTraits& body = traits_[render_mesh_.bodies[a]];
    const float threads = looks[a].threads * (looks[a].place - looks[b].place).norm() / length;
    body.threads = body.threads > 0 ? std::min(body.threads, threads) : threads;
  }
}

GLuint MeshBuffers::texture_of(std::size_t body) const {
  const auto path = render_mesh_.looks.textures.find(static_cast<std::uint32_t>(body));
  if (path == render_mesh_.looks.textures.end()) return no_texture_.id();
  const auto texture = textures_.find(path->second);
  const bool is_there = texture != textures_.end() && texture->second.texture != nullptr;
  return is_there ? texture->second.texture->id() : no_texture_.id();
}

void MeshBuffers::draw_looks(int unit, float pixel, const std::function<void(const SurfaceTraits&)>& use) const {
  constexpr float too_many = 0.6F;  // threads in a pixel, a little more than the program shows
  const std::vector<std::uint32_t>& first = drawn().first_corners;
  glBindVertexArray(triangles_array_.id());
  const auto look_of = [&](std::size_t body) {
    SurfaceTraits traits = traits_[body].traits;
    traits.has_weave = traits.has_weave && traits_[body].threads * pixel < too_many;
    return std::pair(texture_of(body), traits);
  };
  for (std::size_t body = 0; body + 1 < first.size();) {  // those of one look at once
    const std::size_t begin = body;
    const auto look = look_of(begin);
    while (body + 1 < first.size() && look_of(body) == look) ++body;
    const std::uint32_t count = first[body] - first[begin];
    if (count == 0) continue;
    use(look.second);
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, look.first);
    glActiveTexture(GL_TEXTURE0);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                   offset_of(first[begin] * sizeof(std::uint32_t)));
  }
}

void MeshBuffers::draw_ropes() const {
  glBindVertexArray(ropes_array_.id());
  glDrawElements(GL_LINES, size_of(drawn().ropes), GL_UNSIGNED_INT, nullptr);
}

void MeshBuffers::draw_edges() const {
  glBindVertexArray(edges_array_.id());
  glDrawElements(GL_LINES, size_of(drawn().edges), GL_UNSIGNED_INT, nullptr);
}

}  // namespace pliant_render
