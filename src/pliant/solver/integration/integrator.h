#pragma once
// Implicit Euler and BDF2 as one form: a step to q with v = (q − a)/η from s = a + η b + η² M⁻¹ f, whose objective has
// the inertia M/η². Implicit Euler has η = h, a = qₙ, b = vₙ. BDF2, (3q − 4qₙ + qₙ₋₁)/(2h) = v and the same for v, has
// η = 2h/3, a = (4qₙ − qₙ₋₁)/3, b = (4vₙ − vₙ₋₁)/3.
#include "pliant/solver/settings.h"
#include "pliant/solver/state.h"

namespace pliant {

/// Whether the next step of length h has what BDF2 and an adaptive start need: a step of the same length before it.
inline bool has_history(const State& state, Real h) {
  return state.previous_time_step == h && state.previous_positions.rows() == state.positions.rows();
}

inline void make_room_for_history(State& state) {
  state.previous_positions.resize(state.positions.rows(), 3);  // nothing happens where it has as many
  state.previous_velocities.resize(state.positions.rows(), 3);
}

/// η of steps with a history [s].
inline Real inertia_step(Integrator integrator, Real h) {
  return integrator == Integrator::bdf2 ? 2 * h / 3 : h;
}

/// By what a step of length h multiplies the amplitude of an undamped vibration ω: |λ| of the slowest of its solutions.
Real amplification(Integrator integrator, Real h_omega);

/// One step's form; refers to the state that it is made of.
class IntegratorCoefficients {
 public:
  IntegratorCoefficients(const State& state, Integrator integrator, Real h)
      : state_(state),
        is_bdf2_(integrator == Integrator::bdf2 && has_history(state, h)),
        inertia_step_(is_bdf2_ ? pliant::inertia_step(Integrator::bdf2, h) : h) {}

  /// η [s]
  Real inertia_step() const { return inertia_step_; }
  using RowVec3 = Eigen::Matrix<Real, 1, 3>;
  /// a of a vertex [m]
  RowVec3 position(Index vertex) const { return mix(state_.positions, state_.previous_positions, vertex); }
  /// b of a vertex [m/s]
  RowVec3 velocity(Index vertex) const { return mix(state_.velocities, state_.previous_velocities, vertex); }

 private:
  RowVec3 mix(const Positions& now, const Positions& before, Index vertex) const {
    return is_bdf2_ ? RowVec3((4 * now.row(vertex) - before.row(vertex)) / 3) : RowVec3(now.row(vertex));
  }

  const State& state_;
  bool is_bdf2_;
  Real inertia_step_;
};

}  // namespace pliant
