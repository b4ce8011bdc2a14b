#include "pliant/scene/timeline.h"

#include <cmath>

#include <fmt/format.h>

namespace pliant {

void Timeline::add(Simulation& simulation, Move move) {
  const Index count = simulation.target_count(move.group);
  if (count == 0) fail_input("the group has no targets to be moved; only positions and drags have");
  if (move.index && (*move.index < 0 || *move.index >= count)) {
    fail_input(fmt::format("index {} is out of range; the group has constraints 0 to {}", *move.index, count - 1));
  }
  if (move.step < 0) fail_input(fmt::format("step {} is before the start; steps count from 0", move.step));
  if (!(move.duration >= 0) || !std::isfinite(move.duration)) {
    fail_input(fmt::format("{} s is no duration; give a finite number from 0 up", move.duration));
  }
  const auto moved = static_cast<std::size_t>(move.index ? 1 : count);
  if (move.to.empty() || (move.to.each() && move.to.list().size() != moved)) {
    fail_input(
        fmt::format("{} points for {} constraints; give one for all, or one each", move.to.list().size(), moved));
  }
  for (const Vec3& point : move.to.list()) {
    if (!point.allFinite()) fail_input("a point is not finite; give three finite numbers");
  }
  pending_.emplace(move.step, std::move(move));
}

void Timeline::apply(Simulation& simulation) {
  const State& state = simulation.state();
  while (!pending_.empty() && pending_.begin()->first <= state.step) {
    // A group that was removed takes its moves along.
    if (simulation.groups().contains(pending_.begin()->second.group)) begin(simulation, pending_.begin()->second);
    pending_.erase(pending_.begin());
  }
  std::erase_if(motions_, [&](const auto& motion) { return !simulation.groups().contains(motion.first.first); });
  const Real end_of_step = state.time + simulation.settings().time_step;
  for (auto motion = motions_.begin(); motion != motions_.end();) {
    const auto& [from, to, begin, duration] = motion->second;
    const auto& [group, index] = motion->first;
    const Real elapsed = end_of_step - begin;
    const bool arrived = elapsed >= duration * (1 - 1e-9);  // rounding of the time costs no further step
    simulation.set_target(group, index, arrived ? to : Vec3(from + elapsed / duration * (to - from)));
    motion = arrived ? motions_.erase(motion) : std::next(motion);
  }
}

void Timeline::begin(Simulation& simulation, const Move& move) {
  const Index first = move.index.value_or(0);
  const Index last = move.index.value_or(simulation.target_count(move.group) - 1);
  for (Index i = first; i <= last; ++i) {
    const Vec3 from = simulation.target(move.group, i);
    const Vec3& point = move.to[i - first];
    const Vec3 to = move.kind == MoveKind::target ? point : Vec3(from + point);
    motions_.insert_or_assign({move.group, i}, Motion{from, to, simulation.state().time, move.duration});
  }
}

}  // namespace pliant
