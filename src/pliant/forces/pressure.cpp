#include "pliant/forces/pressure.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "pliant/mesh/geometry.h"
#include "pliant/mesh/topology.h"

namespace pliant {
namespace {

/// The least volume that a gas is thought to have, as a share of the volume at rest.
constexpr Real least_volume = 0.01;

std::vector<Triangle> selected_triangles(const Mesh& mesh, const Selection& on) {
  std::vector<Triangle> triangles = mesh.triangles.empty() ? boundary_triangles(mesh.tetrahedra) : mesh.triangles;
  if (on.everything) return triangles;
  std::vector<char> is_selected(static_cast<std::size_t>(mesh.vertex_count()), 0);
  for (const Index vertex : on.vertices) {
    if (vertex < 0 || vertex >= mesh.vertex_count()) {
      fail_input(fmt::format("pressure: vertex {} is out of range; the body has vertices 0 to {}", vertex,
                             mesh.vertex_count() - 1));
    }
    is_selected[static_cast<std::size_t>(vertex)] = 1;
  }
  std::erase_if(triangles, [&](const Triangle& triangle) {
    return std::ranges::any_of(triangle, [&](Index v) { return is_selected[static_cast<std::size_t>(v)] == 0; });
  });
  return triangles;
}

/// An edge of a triangle, smaller vertex first, and whether the triangle runs along it that way (+1) or back (−1).
using DirectedEdge = std::pair<Edge, int>;

/// Refuses a surface whose triangles do not run along every edge as often one way as the other.
void check_closed(const std::vector<Triangle>& triangles) {
  std::vector<DirectedEdge> directed;
  directed.reserve(3 * triangles.size());
  for (const auto& [a, b, c] : triangles) {
    for (const auto& [from, to] : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) {
      directed.push_back(from < to ? DirectedEdge{{from, to}, 1} : DirectedEdge{{to, from}, -1});
    }
  }
  std::ranges::sort(directed);
  std::vector<Edge> border;
  std::vector<Edge> torn;
  for (auto begin = directed.begin(); begin != directed.end();) {
    const auto end =
        std::find_if(begin, directed.end(), [&](const auto& other) { return other.first != begin->first; });
    int sum = 0;
    for (auto it = begin; it != end; ++it) sum += it->second;
    if (end - begin == 1) {
      border.push_back(begin->first);
    } else if (sum != 0) {
      torn.push_back(begin->first);
    }
    begin = end;
  }
  if (!border.empty()) {
    fail_input(fmt::format(
        "pressure: the surface is open: it has {} boundary edges, the first from vertex {} to {}; close it, or take a "
        "part that is closed",
        border.size(), border.front()[0], border.front()[1]));
  }
  if (!torn.empty()) {
    fail_input(fmt::format(
        "pressure: the triangles at {} edges do not agree on their outside, the first from vertex {} to {}; "
        "turn some of them round",
        torn.size(), torn.front()[0], torn.front()[1]));
  }
}

void check_pressure(const Pressure& options) {
  check_options("pressure", options);
  if (options.model == PressureModel::gas && !(options.pressure + options.ambient > 0)) {
    fail_input(fmt::format("pressure: a gas of {} Pa over {} Pa has none; give a sum above 0", options.pressure,
                           options.ambient));
  }
}

/// Twice the area of a triangle times its normal.
Vec3 cross(const Positions& x, const Triangle& triangle) {
  const Vec3 x0 = row(x, triangle[0]);
  return (row(x, triangle[1]) - x0).cross(row(x, triangle[2]) - x0);
}

}  // namespace

PressureForce::PressureForce(const Mesh& mesh, Index first_vertex, const Pressure& options)
    : triangles_(selected_triangles(mesh, options.on)), options_(options) {
  check_pressure(options_);
  if (triangles_.empty()) fail_input("pressure: there are no triangles to hold it; give it a closed surface");
  check_closed(triangles_);
  rest_volume_ = volume(mesh.vertices);
  const Real size = bounding_box(mesh.vertices).diagonal();
  if (!(std::abs(rest_volume_) > 1e-12 * size * size * size)) {
    fail_input("pressure: the surface encloses no volume at rest; give it some");
  }
  for (Triangle& triangle : triangles_) {
    if (rest_volume_ < 0) std::swap(triangle[1], triangle[2]);
    for (Index& vertex : triangle) vertex += first_vertex;
  }
  rest_volume_ = std::abs(rest_volume_);
}

Real PressureForce::volume(const Positions& positions) const {
  const Vec3 origin = row(positions, triangles_.front()[0]);  // near the body, for the sum's rounding
  Real six_volumes = 0;
  for (const Triangle& triangle : triangles_) {
    six_volumes += (row(positions, triangle[0]) - origin).dot(cross(positions, triangle));
  }
  return six_volumes / 6;
}

Real PressureForce::pressure_at(Real volume) const {
  if (options_.model == PressureModel::constant) return options_.pressure;
  const Real ratio = std::max(volume / rest_volume_, least_volume);
  return (options_.pressure + options_.ambient) / ratio - options_.ambient;
}

void PressureForce::add_to(Positions& forces, const StateView& state, Real) {
  const Real sixth = pressure_at(volume(state.positions)) / 6;
  for (const Triangle& triangle : triangles_) {
    const Vec3 share = sixth * cross(state.positions, triangle);
    for (const Index vertex : triangle) forces.row(vertex) += share.transpose();
  }
}

Real PressureForce::potential(const StateView& state) const {
  const Real v = volume(state.positions);
  const Real gained = v - rest_volume_;
  if (options_.model == PressureModel::constant) return -options_.pressure * gained;
  const Real absolute = options_.pressure + options_.ambient;
  const Real ratio = std::max(v / rest_volume_, least_volume);
  const Real below = std::max(least_volume * rest_volume_ - v, Real(0));
  return options_.ambient * gained - absolute * rest_volume_ * std::log(ratio) + absolute / least_volume * below;
}

Real PressureForce::squared_frequency(const StateView& state) const {
  const Positions& x = state.positions;
  Positions gradient = Positions::Zero(x.rows(), 3);
  std::vector<std::pair<Edge, Vec3>>
      opposite;  // of each edge of each triangle, to its third vertex: as V's Hessian has it
  opposite.reserve(3 * triangles_.size());
  for (const Triangle& triangle : triangles_) {
    const Vec3 share = cross(x, triangle) / 6;
    for (std::size_t i = 0; i < 3; ++i) {
      const Index from = triangle[i];
      const Index to = triangle[(i + 1) % 3];
      gradient.row(from) += share.transpose();
      const Real sign = from < to ? 1 : -1;
      opposite.emplace_back(Edge{std::min(from, to), std::max(from, to)}, sign * row(x, triangle[(i + 2) % 3]));
    }
  }
  std::ranges::sort(opposite, {}, &std::pair<Edge, Vec3>::first);
  std::vector<Real> sums(static_cast<std::size_t>(x.rows()), 0);  // Σⱼ ‖∂²V/∂xᵢ∂xⱼ‖
  for (auto begin = opposite.begin(); begin != opposite.end();) {
    Vec3 difference = Vec3::Zero();
    const Edge edge = begin->first;
    for (; begin != opposite.end() && begin->first == edge; ++begin) difference += begin->second;
    for (const Index vertex : edge) sums[static_cast<std::size_t>(vertex)] += difference.norm() / 6;
  }
  Real mobility = 0;  // Σ ‖aᵢ‖²/mᵢ
  Real softness = 0;  // max Σⱼ ‖∂²V/∂xᵢ∂xⱼ‖/mᵢ
  for (Index i = 0; i < x.rows(); ++i) {
    const Real mass = state.masses[static_cast<std::size_t>(i)];
    mobility += gradient.row(i).squaredNorm() / mass;
    softness = std::max(softness, sums[static_cast<std::size_t>(i)] / mass);
  }
  const Real v = std::max(volume(x), least_volume * rest_volume_);
  const bool is_gas = options_.model == PressureModel::gas;
  const Real slope = is_gas ? (options_.pressure + options_.ambient) * rest_volume_ / (v * v) : 0;
  return slope * mobility + std::abs(pressure_at(v)) * softness;
}

std::optional<std::string> PressureForce::warning(const StateView& state, Real time_step) const {
  const Real limit = 2 / std::sqrt(squared_frequency(state));
  if (!(time_step >= limit)) return std::nullopt;
  return fmt::format(
      "pressure: time step {:g} s is not below the explicit pressure's limit 2/ω = {:g} s, so the surface may crumple "
      "or beat without end; take a smaller time step, a heavier or coarser surface, or less pressure",
      time_step, limit);
}

std::optional<Index> PressureForce::vertex_out_of_range(Index vertex_count) const {
  for (const Triangle& triangle : triangles_) {
    for (const Index vertex : triangle) {
      if (vertex < 0 || vertex >= vertex_count) return vertex;
    }
  }
  return std::nullopt;
}

std::unique_ptr<Force> build(const ForceScope& scope, const Pressure& options) {
  const ForceBody& body = only_body(Pressure::info.name, scope);
  return std::make_unique<PressureForce>(body.rest, body.first_vertex, options);
}

}  // namespace pliant
