#include "pliant/solver/working_state.h"

namespace pliant {

void WorkingState::resize(Index vertex_count) {
  for (Positions* x : {&forces, &prediction, &positions, &residual, &solution, &velocities})
    x->setZero(vertex_count, 3);
  predicted_step = 0;
}

void WorkingState::gather(const State& state, const LocalGroups& order) {
  order.gather(state.positions, begin.positions);
  order.gather(state.velocities, begin.velocities);
  order.gather(state.masses, begin.masses);
  order.gather(state.energy_surplus, begin.energy_surplus);
  begin.previous_time_step = state.previous_time_step;
  if (state.previous_time_step == 0) return;
  order.gather(state.previous_positions, begin.previous_positions);
  order.gather(state.previous_velocities, begin.previous_velocities);
}

void WorkingState::scatter(const LocalGroups& order, bool keeps_history, Real h, State& state) const {
  order.scatter(positions, state.positions);
  order.scatter(velocities, state.velocities);
  order.scatter(energy_surplus, state.energy_surplus);
  state.previous_time_step = keeps_history ? h : 0;
  if (state.previous_time_step == 0) return;
  order.scatter(begin.positions, state.previous_positions);
  order.scatter(begin.velocities, state.previous_velocities);
}

}  // namespace pliant
