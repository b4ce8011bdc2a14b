#include "render/scalar_fields.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <Eigen/LU>
#include <fmt/format.h>

#include "pliant/core/error.h"

namespace pliant_render {
namespace {

using pliant::ColorBy;
using pliant::Real;
using Rgb = std::array<std::uint8_t, 3>;

constexpr std::size_t map_size = 256;

/// Interpolates linearly (sRGB) between evenly spaced colors.
std::vector<Rgb> through(std::span<const Rgb> stops) {
  std::vector<Rgb> map(map_size);
  for (std::size_t i = 0; i < map_size; ++i) {
    const double place = static_cast<double>(i) / (map_size - 1) * static_cast<double>(stops.size() - 1);
    const auto from = std::min(static_cast<std::size_t>(place), stops.size() - 2);
    const double share = place - static_cast<double>(from);
    for (std::size_t c = 0; c < 3; ++c) {
      map[i][c] = static_cast<std::uint8_t>(std::lround((1 - share) * stops[from][c] + share * stops[from + 1][c]));
    }
  }
  return map;
}

/// What is seen of a solid made from its surface has what the lattice has there.
void carry_values(const pliant::Body& body, std::span<float> values) {
  const pliant::Embedding& embedding = body.mesh.embedding;
  for (Index v = 0; v < embedding.carried_count(); ++v) {
    const pliant::Tetrahedron& corners = body.mesh.tetrahedra[pliant::at(embedding.tetrahedra[pliant::at(v)])];
    Real value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      value += embedding.weights[pliant::at(v)][i] * static_cast<Real>(values[pliant::at(corners[i])]);
    }
    values[pliant::at(v)] = static_cast<float>(value);
  }
}

/// Of values that are finite and above zero; `otherwise` where there are none.
float median_above_zero(std::span<const float> values, float otherwise) {
  std::vector<float> counted;
  std::ranges::copy_if(values, std::back_inserter(counted), [](float v) { return v > 0 && std::isfinite(v); });
  if (counted.empty()) return otherwise;
  const auto middle = counted.begin() + static_cast<std::ptrdiff_t>(counted.size() / 2);
  std::ranges::nth_element(counted, middle);
  return *middle;
}

}  // namespace

std::vector<float> vertex_stretch(const RenderMesh& render_mesh, std::span<const Vec3f> positions) {
  std::vector<float> sums(positions.size(), 0);
  std::vector<float> counts(positions.size(), 0);
  for (std::size_t e = 0; e < render_mesh.rest_lengths.size(); ++e) {
    const std::uint32_t a = render_mesh.springs[2 * e], b = render_mesh.springs[2 * e + 1];
    if (!(render_mesh.rest_lengths[e] > 0)) continue;
    const float stretch = (positions[b] - positions[a]).norm() / render_mesh.rest_lengths[e] - 1;
    for (const std::uint32_t vertex : {a, b}) {
      sums[vertex] += stretch;
      counts[vertex] += 1;
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= std::max(counts[i], 1.0F);
  return sums;
}

std::vector<float> vertex_energy(const pliant::Simulation& simulation) {
  const pliant::Positions& q = simulation.state().positions;
  std::vector<float> energies(static_cast<std::size_t>(q.rows()), 0);
  std::vector<Real> slots;
  for (const auto& [id, group] : simulation.groups()) {
    for (const auto& batch : group.set.batches) {
      const pliant::GroupShape shape = batch->shape();
      const auto n = static_cast<std::size_t>(shape.vertices);
      slots.resize(3 * static_cast<std::size_t>(shape.rows));
      for (Index i = 0; i < shape.count; ++i) {
        const Real energy = batch->project(q, slots, i, i + 1);
        for (const Index vertex : batch->stencil().subspan(static_cast<std::size_t>(i) * n, n)) {
          energies[static_cast<std::size_t>(vertex)] += static_cast<float>(energy / static_cast<Real>(n));
        }
      }
    }
  }
  for (const pliant::Body& body : simulation.bodies()) {
    carry_values(body,
                 std::span(energies).subspan(pliant::at(body.first_vertex), pliant::at(body.mesh.vertex_count())));
  }
  return energies;
}

std::vector<float> vertex_speed(const pliant::Positions& velocities) {
  std::vector<float> speeds(static_cast<std::size_t>(velocities.rows()));
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    speeds[i] = static_cast<float>(velocities.row(static_cast<Eigen::Index>(i)).norm());
  }
  return speeds;
}

std::vector<float> vertex_gap(const pliant::Simulation& simulation) {
  Real most = 0;
  for (Index b = 0; b < pliant::count_of(simulation.bodies()); ++b) {
    most = std::max(most, simulation.contact_distance(pliant::BodyId{b}));
  }
  std::vector<float> gaps;
  for (const pliant::VertexTouch& each : simulation.touches()) {
    gaps.push_back(static_cast<float>(std::clamp<Real>(each.gap, 0, most)));
  }
  return gaps;
}

std::vector<float> vertex_contact_force(const pliant::Simulation& simulation) {
  std::vector<float> forces;
  for (const pliant::VertexTouch& each : simulation.touches()) forces.push_back(static_cast<float>(each.force.norm()));
  return forces;
}

bool is_known_of_runs(ColorBy color) {
  return color == ColorBy::none || color == ColorBy::stretch || color == ColorBy::speed;
}

void check_known_of_runs(ColorBy color) {
  if (is_known_of_runs(color)) return;
  const std::string_view what = color == ColorBy::energy ? "the energy of its vertices" : "what its vertices touch";
  pliant::fail_input(fmt::format("color: a run does not say {}; give its scene, or another color", what));
}

std::string_view field_title(ColorBy color) {
  switch (color) {
    case ColorBy::stretch:
      return "stretch [%]";
    case ColorBy::energy:
      return "elastic energy [J]";
    case ColorBy::speed:
      return "speed [m/s]";
    case ColorBy::gap:
      return "gap [mm]";
    case ColorBy::contact_force:
      return "contact [N]";
    case ColorBy::none:
      break;
  }
  return "";
}

float field_scale(ColorBy color) {
  return color == ColorBy::stretch ? 100.0F : color == ColorBy::gap ? 1000.0F : 1.0F;
}

std::array<float, 2> field_range(ColorBy color, std::span<const float> values) {
  float largest = 0;
  for (const float value : values) {
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  if (color == ColorBy::contact_force) largest = median_above_zero(values, largest);
  if (!(largest > 0)) largest = 1;
  return {color == ColorBy::stretch ? -largest : 0, largest};
}

std::vector<Rgb> color_map(ColorBy color) {
  // Lightness rises evenly in the first; the second is as dark at both ends.
  constexpr std::array<Rgb, 6> rising = {Rgb{58, 62, 128},  Rgb{55, 96, 150},  Rgb{38, 138, 148},
                                         Rgb{68, 178, 124}, Rgb{158, 215, 98}, Rgb{250, 238, 150}};
  constexpr std::array<Rgb, 5> both_ways = {Rgb{33, 86, 163}, Rgb{134, 178, 216}, Rgb{240, 238, 233},
                                            Rgb{231, 151, 119}, Rgb{176, 42, 48}};
  return color == ColorBy::stretch ? through(both_ways) : through(rising);
}

}  // namespace pliant_render
