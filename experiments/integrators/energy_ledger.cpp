#include "integrators/energy_ledger.h"

#include <algorithm>
#include <numeric>

namespace pliant_experiments {

EnergyLedger::EnergyLedger(pliant::Simulation& simulation) : simulation_(simulation) {
  open_account();
}

double EnergyLedger::noted_surplus() const {
  const std::vector<pliant::Real>& surplus = simulation_.state().energy_surplus;
  return std::accumulate(surplus.begin(), surplus.end(), 0.0);
}

std::vector<pliant::Vec3> EnergyLedger::targets() const {
  std::vector<pliant::Vec3> all;
  for (const auto& [id, group] : simulation_.groups()) {
    for (pliant::Index i = 0; i < simulation_.target_count(id); ++i) all.push_back(simulation_.target(id, i));
  }
  return all;
}

void EnergyLedger::open_account() {
  const pliant::State& state = simulation_.state();
  energy_ = kinetic_energy(state) + simulation_.evaluate().elastic;
  for (const auto& [id, force] : simulation_.forces()) energy_ += force->potential(state.view());
  account_ = energy_ - noted_surplus();
}

void EnergyLedger::before_step() {
  const pliant::State& state = simulation_.state();
  positions_ = state.positions;
  targets_ = targets();
  forces_.setZero(state.positions.rows(), 3);
  for (const auto& [id, force] : simulation_.forces()) {
    if (!force->is_conservative()) force->add_to(forces_, state.view(), simulation_.settings().time_step);
  }
}

void EnergyLedger::after_step() {
  const double work = forces_.cwiseProduct(simulation_.state().positions - positions_).sum();
  const double allowed = account_ + work;
  open_account();
  if (targets() == targets_) {
    gain_ = std::max(gain_, account_ - allowed);
    account_ = allowed;
  }
  const double kinetic = kinetic_energy(simulation_.state());
  largest_surplus_ = std::max(largest_surplus_, noted_surplus());
  largest_kinetic_ = std::max(largest_kinetic_, kinetic);
  kinetic_sum_ += kinetic;
  ++steps_;
}

double kinetic_energy(const pliant::State& state) {
  double energy = 0;
  for (pliant::Index i = 0; i < state.vertex_count(); ++i) {
    energy += state.masses[static_cast<std::size_t>(i)] / 2 * state.velocities.row(i).squaredNorm();
  }
  return energy;
}

}  // namespace pliant_experiments
