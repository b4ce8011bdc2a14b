#include "viewer/measure_selection.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

namespace pliant_viewer {

SelectionMeasures measure_selection(std::span<const std::uint32_t> selected,
                                    const pliant_render::RenderMesh& render_mesh, std::span<const Vec3f> positions) {
  SelectionMeasures measures;
  if (selected.size() == 1) measures.position = positions[selected[0]];
  if (selected.size() == 2) measures.between = positions[selected[1]] - positions[selected[0]];
  std::vector<char> is_in(positions.size(), 0);  // looked up for every edge, with every picture
  for (const std::uint32_t vertex : selected) is_in[vertex] = 1;
  for (std::size_t s = 0; s < render_mesh.rest_lengths.size() && !selected.empty(); ++s) {
    const std::uint32_t a = render_mesh.springs[2 * s], b = render_mesh.springs[2 * s + 1];
    const bool counts = selected.size() == 1 ? is_in[a] + is_in[b] > 0 : is_in[a] + is_in[b] == 2;
    if (!counts || !(render_mesh.rest_lengths[s] > 0)) continue;
    const float stretch = (positions[b] - positions[a]).norm() / render_mesh.rest_lengths[s];
    const auto [least, most] = measures.stretch.value_or(std::array{stretch, stretch});
    measures.stretch = {std::min(least, stretch), std::max(most, stretch)};
  }
  return measures;
}

VertexName name_of(std::uint32_t vertex, const pliant_render::RenderMesh& render_mesh) {
  const std::uint32_t body = render_mesh.bodies[vertex];
  const auto first = std::ranges::lower_bound(render_mesh.bodies, body);
  return {body, vertex - static_cast<std::uint32_t>(first - render_mesh.bodies.begin())};
}

std::string scene_text_of(std::span<const std::uint32_t> selected, const pliant_render::RenderMesh& render_mesh,
                          const std::vector<std::string>& body_names) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> numbers;
  for (const std::uint32_t vertex : selected) {
    const VertexName name = name_of(vertex, render_mesh);
    numbers[name.body].push_back(name.number);
  }
  std::string text;
  for (const auto& [body, of_body] : numbers) {
    const std::string list = fmt::format("[{}]", fmt::join(of_body, ", "));
    if (numbers.size() == 1) return list;
    text += fmt::format("{}: {}\n", body_names.at(body), list);
  }
  return text;
}

}  // namespace pliant_viewer
