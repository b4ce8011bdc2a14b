#include "support/xpbd.h"

#include "pliant/core/error.h"

namespace pliant_experiments {

using namespace pliant;

Xpbd::Xpbd(const Simulation& simulation, const XpbdOptions& options)
    : model_(mass_spring(simulation)), options_(options), time_step_(simulation.settings().time_step) {
  if (!model_.soft_pins.empty()) fail_input("position-based dynamics has no soft pins here; make them hard");
  const State& state = simulation.state();
  positions_ = state.positions;
  velocities_ = state.velocities;
  accelerations_ = Positions::Zero(model_.vertex_count(), 3);
  for (const auto& [id, force] : simulation.forces()) force->add_to(accelerations_, state.view(), time_step_);
  for (Index i = 0; i < model_.vertex_count(); ++i) {
    const auto vertex = static_cast<std::size_t>(i);
    inverse_masses_.push_back(model_.is_pinned[vertex] != 0 ? 0 : 1 / model_.masses[vertex]);
    accelerations_.row(i) *= inverse_masses_.back();
  }
  multipliers_.resize(model_.springs.size());
}

void Xpbd::set_state(const Positions& positions, const Positions& velocities) {
  positions_ = positions;
  velocities_ = velocities;
}

void Xpbd::step() {
  for (int i = 0; i < options_.substeps; ++i) substep(time_step_ / options_.substeps);
}

void Xpbd::substep(double time_step) {
  before_ = positions_;
  for (Index i = 0; i < model_.vertex_count(); ++i) {
    if (inverse_masses_[static_cast<std::size_t>(i)] == 0) continue;
    positions_.row(i) += time_step * velocities_.row(i) + time_step * time_step * accelerations_.row(i);
  }
  std::fill(multipliers_.begin(), multipliers_.end(), 0.);
  for (int iteration = 0; iteration < options_.iterations; ++iteration) {
    for (std::size_t i = 0; i < model_.springs.size(); ++i) correct(i, 1 / (time_step * time_step));
  }
  velocities_ = (positions_ - before_) / time_step;
}

void Xpbd::correct(std::size_t i, double compliance_factor) {
  const Spring& spring = model_.springs[i];
  const double inverse_from = inverse_masses_[static_cast<std::size_t>(spring.from)];
  const double inverse_to = inverse_masses_[static_cast<std::size_t>(spring.to)];
  if (inverse_from + inverse_to == 0) return;
  const Vec3 edge = row(positions_, spring.to) - row(positions_, spring.from);
  const double length = edge.norm();
  const double excess = length - spring.rest_length;
  double change = 0;  // of λ
  if (options_.pbd_share) {
    change = -*options_.pbd_share * excess / (inverse_from + inverse_to);
  } else {
    const double compliance = compliance_factor / spring.stiffness;
    change = -(excess + compliance * multipliers_[i]) / (inverse_from + inverse_to + compliance);
    multipliers_[i] += change;
  }
  const Vec3 move = change / length * edge;
  positions_.row(spring.to) += inverse_to * move.transpose();
  positions_.row(spring.from) -= inverse_from * move.transpose();
}

}  // namespace pliant_experiments
