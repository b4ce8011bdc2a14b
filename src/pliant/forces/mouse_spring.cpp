#include "pliant/forces/mouse_spring.h"

#include <fmt/format.h>

namespace pliant {

MouseSpring::MouseSpring(Index vertex, const MouseSpringOptions& options) : vertex_(vertex), options_(options) {
  check_options("mouse_spring", options_);
}

void MouseSpring::add_to(Positions& forces, const StateView& state, Real) {
  const Vec3 d = options_.anchor - row(state.positions, vertex_);
  const Real length = d.stableNorm();
  if (!(length > 0)) return;  // no direction, no force
  forces.row(vertex_) += (options_.stiffness * (length - options_.rest_length) / length * d).transpose();
}

void MouseSpring::set_anchor(const Vec3& anchor) {
  if (!anchor.allFinite()) fail_input("mouse_spring: the anchor is not finite; give three finite numbers");
  options_.anchor = anchor;
}

std::optional<Index> MouseSpring::vertex_out_of_range(Index vertex_count) const {
  return vertex_ >= 0 && vertex_ < vertex_count ? std::nullopt : std::optional(vertex_);
}

Real MouseSpring::potential(const StateView& state) const {
  const Real stretch = (options_.anchor - row(state.positions, vertex_)).stableNorm() - options_.rest_length;
  return options_.stiffness / 2 * stretch * stretch;
}

std::optional<std::string> MouseSpring::warning(const StateView& state, Real time_step) const {
  const Real mass = state.masses[static_cast<std::size_t>(vertex_)];
  const Real limit = 4 * mass / (time_step * time_step);
  if (options_.stiffness < limit) return std::nullopt;
  return fmt::format(
      "mouse_spring on vertex {}: stiffness {} N/m is not below the explicit spring's limit 4 m/h² = {} N/m, so it may "
      "grow without bound; use a drag, which has no limit",
      vertex_, options_.stiffness, limit);
}

}  // namespace pliant
