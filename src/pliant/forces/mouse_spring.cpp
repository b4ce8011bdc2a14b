#include "pliant/forces/mouse_spring.h"

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

std::optional<std::string> MouseSpring::warning(const StateView& state, Real time_step) const {
  const Real mass = state.masses[static_cast<std::size_t>(vertex_)];
  const Real limit = 4 * mass / (time_step * time_step);
  if (options_.stiffness < limit) return std::nullopt;
  return "mouse_spring on vertex " + std::to_string(vertex_) + ": stiffness " + std::to_string(options_.stiffness) +
         " N/m is not below the explicit spring's limit 4 m/h² = " + std::to_string(limit) +
         " N/m, so it may grow without bound; use a drag, which has no limit";
}

}  // namespace pliant
