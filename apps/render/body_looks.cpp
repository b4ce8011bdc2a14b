#include "render/body_looks.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "render/render_mesh.h"

namespace pliant_render {
namespace {

std::array<std::uint8_t, 4> bytes(const pliant::Color& color, std::uint8_t fourth) {
  const auto byte = [](pliant::Real share) { return static_cast<std::uint8_t>(std::lround(255 * share)); };
  return {byte(color.red), byte(color.green), byte(color.blue), fourth};
}

void look_at(std::span<VertexLook> looks, const pliant::Positions& rest, const pliant::BodyAppearance& appearance,
             const pliant::BodyTones& tones) {
  VertexLook look;
  const pliant::Color front = appearance.front.value_or(tones.front);
  look.front = bytes(front, 255);
  look.back = bytes(appearance.back.value_or(appearance.front ? front : tones.back),
                    static_cast<std::uint8_t>(appearance.pattern));
  look.second = bytes(appearance.pattern_color, 0);
  const std::array<Eigen::Index, 3> axes = axes_by_length(rest);
  for (std::size_t i = 0; i < looks.size(); ++i) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const pliant::Real along = rest(static_cast<Eigen::Index>(i), axes[static_cast<std::size_t>(k)]);
      look.place[k] = static_cast<float>(along / appearance.pattern_size) + static_cast<float>(off_the_edge);
    }
    looks[i] = look;
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

std::vector<VertexLook> vertex_looks(const std::vector<pliant::Body>& bodies,
                                     const std::map<pliant::BodyId, pliant::BodyAppearance>& appearances) {
  std::vector<VertexLook> looks;
  if (appearances.empty() || bodies.empty()) return looks;
  Index count = 0;
  for (const pliant::Body& body : bodies) count = std::max(count, body.first_vertex + body.mesh.vertex_count());
  looks.resize(static_cast<std::size_t>(count));
  for (const auto& [id, appearance] : appearances) {
    const auto number = static_cast<std::size_t>(id);
    const pliant::Body& body = bodies[number];
    if (body.mesh.vertex_count() == 0) continue;
    const auto vertices = std::span(looks).subspan(static_cast<std::size_t>(body.first_vertex),
                                                   static_cast<std::size_t>(body.mesh.vertex_count()));
    look_at(vertices, body.mesh.vertices, appearance, open_tones(number));
  }
  return looks;
}

}  // namespace pliant_render
