#include "render/body_looks.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "render/picture_places.h"
#include "render/render_mesh.h"

namespace pliant_render {
namespace {

using pliant::Real;

std::array<std::uint8_t, 4> bytes(const pliant::Color& color, std::uint8_t fourth) {
  const auto byte = [](pliant::Real share) { return static_cast<std::uint8_t>(std::lround(255 * share)); };
  return {byte(color.red), byte(color.green), byte(color.blue), fourth};
}

/// From thread to thread [m], about what such cloth has.
Real usual_weave(std::string_view material) {
  constexpr std::array<std::pair<std::string_view, Real>, 7> weaves = {{{"cotton", 0.25e-3},
                                                                        {"denim", 0.45e-3},
                                                                        {"faille", 0.2e-3},
                                                                        {"habotai", 0.15e-3},
                                                                        {"polyester", 0.3e-3},
                                                                        {"silk", 0.12e-3},
                                                                        {"wool", 0.5e-3}}};
  const auto found = std::ranges::find(weaves, material, &std::pair<std::string_view, Real>::first);
  return found == weaves.end() ? 0 : found->second;
}

/// Meters at rest for a unit of the texture coordinates, in the mean.
Real meters_of_uv(const pliant::Mesh& mesh) {
  const pliant::PolygonFaces& faces = mesh.faces;
  Real area = 0, area_of_uv = 0;
  for (std::size_t face = 1; face < faces.offsets.size(); ++face) {
    const auto first = static_cast<std::size_t>(faces.offsets[face - 1]);
    const auto end = static_cast<std::size_t>(faces.offsets[face]);
    for (std::size_t corner = first + 2; corner < end; ++corner) {
      const auto side = [&](std::size_t to) -> pliant::Vec3 {
        return (mesh.vertices.row(faces.vertices[to]) - mesh.vertices.row(faces.vertices[first])).transpose();
      };
      const Index start = faces.texture_coordinates[first], a = faces.texture_coordinates[corner - 1],
                  b = faces.texture_coordinates[corner];
      if (std::min({start, a, b}) < 0) continue;
      const auto& uv = mesh.texture_coordinates;
      const Eigen::Vector2d u = (uv.row(a) - uv.row(start)).transpose(), v = (uv.row(b) - uv.row(start)).transpose();
      area += side(corner - 1).cross(side(corner)).norm();
      area_of_uv += std::abs(u.x() * v.y() - u.y() * v.x());
    }
  }
  return area_of_uv > 0 ? std::sqrt(area / area_of_uv) : 1;
}

/// Where places lie: textures begin at the lowest corner of what they are laid through, fields a third before it.
void place_at_rest(std::span<VertexLook> looks, const pliant::Positions& rest, Real size, bool is_texture) {
  const std::array<Eigen::Index, 3> axes = axes_by_length(rest);
  const pliant::Vec3 low = rest.colwise().minCoeff().transpose();
  for (std::size_t i = 0; i < looks.size(); ++i) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Eigen::Index axis = axes[static_cast<std::size_t>(k)];
      const Real along = rest(static_cast<Eigen::Index>(i), axis) - (is_texture ? low[axis] : 0);
      looks[i].place[k] = static_cast<float>(along / size + (is_texture ? 0 : off_the_edge));
    }
  }
}

void set_colors(VertexLook& look, const pliant::BodyAppearance& appearance, bool is_by_uv,
                const pliant::BodyTones& tones) {
  const pliant::Color front = appearance.front.value_or(tones.front);
  auto pattern = static_cast<std::uint8_t>(appearance.pattern);
  if (!appearance.texture.empty()) {
    pattern = static_cast<std::uint8_t>(texture_pattern + (appearance.back ? 1 : 0) + (is_by_uv ? 2 : 0));
  }
  look.front = bytes(front, 255);
  look.back = bytes(appearance.back.value_or(appearance.front ? front : tones.back), pattern);
  look.second = bytes(appearance.pattern_color, 0);
}

/// Of a body with an appearance, or of a material that looks like something.
void look_at(std::span<VertexLook> looks, const pliant::Mesh& mesh, const pliant::BodyAppearance* given,
             const std::string& material, const pliant::BodyTones& tones) {
  const pliant::BodyAppearance appearance = given != nullptr ? *given : pliant::BodyAppearance{};
  const bool is_sheet = mesh.tetrahedra.empty() && !mesh.triangles.empty();
  const bool is_texture = !appearance.texture.empty();
  const Real size = is_texture ? appearance.texture_size : appearance.pattern_size;
  VertexLook look;
  const bool is_by_uv = lies_by_coordinates(appearance, mesh);
  if (given != nullptr) set_colors(look, appearance, is_by_uv, tones);
  look.second[3] = static_cast<std::uint8_t>(finish_of(appearance, material, is_sheet));
  const Real weave = is_sheet ? appearance.weave.value_or(usual_weave(material)) : appearance.weave.value_or(0);
  if (weave > 0) look.threads = static_cast<float>(size * (is_by_uv ? meters_of_uv(mesh) : 1) / weave);
  std::ranges::fill(looks, look);
  if (!is_by_uv) return place_at_rest(looks, mesh.vertices, size, is_texture);
  for (VertexLook& each : looks) {
    each.by_uv = static_cast<float>(1 / size);
    each.place.z() = static_cast<float>(off_the_edge);
  }
}

}  // namespace

std::array<Eigen::Index, 3> axes_by_length(const pliant::Positions& rest) {
  const pliant::Vec3 extent = (rest.colwise().maxCoeff() - rest.colwise().minCoeff()).transpose();
  std::array<Eigen::Index, 3> axes = {0, 1, 2};
  // In thousandths of the longest, so that equal ones stay in their order, whatever rounding does.
  const auto length = [&](Eigen::Index axis) { return std::round(1000 * extent[axis] / extent.maxCoeff()); };
  if (extent.maxCoeff() > 0) std::ranges::stable_sort(axes, std::ranges::greater(), length);
  return axes;
}

pliant::Finish finish_of(const pliant::BodyAppearance& appearance, const std::string& material, bool is_sheet) {
  if (appearance.finish != pliant::Finish::automatic) return appearance.finish;
  if (material.starts_with("steel")) return pliant::Finish::metal;
  if (material.starts_with("rubber") || material.starts_with("silicone")) return pliant::Finish::glossy;
  if (material == "leather" || material == "paper") return pliant::Finish::matte;
  return is_sheet ? pliant::Finish::cloth : pliant::Finish::matte;
}

const pliant::BodyTones& open_tones(std::size_t body) {
  return pliant::body_tones[body % pliant::body_tones.size()];
}

BodyLooks body_looks(const std::vector<pliant::Body>& bodies,
                     const std::map<pliant::BodyId, pliant::BodyAppearance>& appearances,
                     const std::map<pliant::BodyId, pliant::Material>& materials,
                     const std::map<std::string, pliant::ColliderAppearance, std::less<>>& colliders) {
  BodyLooks looks;
  for (const auto& [name, appearance] : colliders) looks.colliders.emplace(name, collider_look(appearance));
  Index count = 0;
  for (const pliant::Body& body : bodies) count = std::max(count, body.first_vertex + body.mesh.vertex_count());
  if (appearances.empty() && materials.empty()) return looks;
  looks.vertices.resize(static_cast<std::size_t>(count));
  for (std::size_t number = 0; number < bodies.size(); ++number) {
    const pliant::BodyId id{static_cast<Index>(number)};
    const auto appearance = appearances.find(id);
    const auto material = materials.find(id);
    const pliant::Mesh& mesh = bodies[number].mesh;
    if ((appearance == appearances.end() && material == materials.end()) || mesh.vertex_count() == 0) continue;
    const auto vertices = std::span(looks.vertices)
                              .subspan(static_cast<std::size_t>(bodies[number].first_vertex),
                                       static_cast<std::size_t>(mesh.vertex_count()));
    look_at(vertices, mesh, appearance == appearances.end() ? nullptr : &appearance->second,
            material == materials.end() ? "" : material->second.name, open_tones(number));
    if (appearance == appearances.end() || appearance->second.texture.empty()) continue;
    looks.textures[static_cast<std::uint32_t>(number)] = appearance->second.texture;
  }
  return looks;
}

}  // namespace pliant_render
