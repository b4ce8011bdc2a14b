#include "pliant/simulation/step_error.h"

#include <algorithm>
#include <cmath>

#include "pliant/core/error.h"

namespace pliant {
namespace {

constexpr Index reference_factor = 8;
constexpr Index least_reference = 160;
constexpr Index most_reference = 2000;

/// The coming step, taken as often as one likes. The simulation has its state and its settings again at the end.
class Trial {
 public:
  Trial(Simulation& simulation, Index iterations)
      : simulation_(simulation), settings_(simulation.settings()), start_(simulation.state()) {
    simulation_.restore(start_);  // so that whoever keeps states keeps this one
    SolverSettings many = settings_;
    many.acceleration = Acceleration::lbfgs;
    many.tolerance = 0;
    many.iterations =
        std::clamp(reference_factor * std::min(iterations, most_reference), least_reference, most_reference);
    most_ = many.iterations / 4;
    reference_ = positions_after(many);
  }

  /// With more iterations than these the reference says little.
  Index most_iterations() const { return most_; }

  StepError error_after(Index iterations) {
    SolverSettings settings = settings_;
    settings.iterations = iterations;
    const Positions end = positions_after(settings);
    StepError worst;
    const std::vector<Body>& bodies = simulation_.bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const StepError error = error_of(bodies[i], end);
      if (i > 0 && error.share <= worst.share) continue;
      worst = error;
      worst.body = BodyId(static_cast<Index>(i));
    }
    return worst;
  }

 private:
  /// Leaves the simulation as it was.
  Positions positions_after(const SolverSettings& settings) {
    const auto go_back = [this] {
      simulation_.restore(start_);
      simulation_.set_settings(settings_);
    };
    simulation_.set_settings(settings);
    Positions positions;
    try {
      simulation_.step();
      positions = simulation_.state().positions;
    } catch (...) {
      go_back();
      throw;
    }
    go_back();
    return positions;
  }

  StepError error_of(const Body& body, const Positions& end) const {
    const Real h = settings_.time_step;
    Real mass = 0, error = 0, change = 0;
    for (Index i = body.first_vertex; i < body.first_vertex + body.mesh.vertex_count(); ++i) {
      const Real m = start_.masses[static_cast<std::size_t>(i)];
      const Vec3 without_forces = row(start_.positions, i) + h * row(start_.velocities, i);
      mass += m;
      error += m * (row(end, i) - row(reference_, i)).squaredNorm();
      change += m * (row(reference_, i) - without_forces).squaredNorm();
    }
    StepError result;
    result.distance = std::sqrt(error / mass);
    result.acceleration = result.distance / (h * h);
    result.share = result.acceleration / std::max(standard_gravity, std::sqrt(change / mass) / (h * h));
    return result;
  }

  Simulation& simulation_;
  const SolverSettings settings_;
  const State start_;
  Positions reference_;
  Index most_ = 0;
};

bool is_regular_look(std::int64_t step) {
  return step == 10 || step == 30 || step == 90 || (step > 0 && step % 180 == 0);
}

/// Which steps after a change are looked at.
enum class Follow { none, first, second, last };

Follow follow(const State& state) {
  constexpr std::int64_t last_look = 30;
  if (state.changed_step == 0) return Follow::none;
  const std::int64_t passed = state.step - state.changed_step;
  if (passed == 0) return Follow::first;
  // Where a change is followed later than it was made, the second look at the one before may still be to come.
  if (passed == look_after_change || passed == look_after_change - change_gap) return Follow::second;
  return passed == last_look ? Follow::last : Follow::none;
}

Index find_enough(Trial& trial, Index iterations, const SolverSettings& settings, bool may_be_fewer) {
  constexpr Index least = 5;
  const auto fits = [&](Index n) { return trial.error_after(n).share <= settings.step_error; };
  const StepError now = trial.error_after(iterations);
  if (now.share <= settings.step_error / 2) {
    if (!may_be_fewer) return iterations;
    const Index fewer = std::max(least, 2 * iterations / 3);
    return fewer < iterations && fits(fewer) ? fewer : iterations;
  }
  const Index most = std::min(settings.most_iterations, trial.most_iterations());
  bool is_enough = now.share <= settings.step_error;
  while (!is_enough && iterations < most) {
    iterations = std::min(most, iterations + (iterations + 1) / 2);
    is_enough = fits(iterations);
  }
  return iterations;
}

}  // namespace

std::optional<StepError> find_step_error(Simulation& simulation) {
  try {
    const Index iterations = iterations_of(simulation.settings(), simulation.state().iterations);
    if (iterations >= most_reference) return std::nullopt;
    return Trial(simulation, iterations).error_after(iterations);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::diverged) throw;
    return std::nullopt;
  }
}

bool finds_iterations(const State& state) {
  return is_regular_look(state.step) || follow(state) != Follow::none;
}

void find_iterations(Simulation& simulation) {
  State state = simulation.state();
  const Follow followed = follow(state);
  Index iterations = iterations_of(simulation.settings(), state.iterations);
  if (followed == Follow::first) {
    iterations = std::max(iterations, iterations_of(simulation.settings(), 0));
    state.iterations = iterations;  // also where nothing is found
  }
  try {
    const bool may_be_fewer = followed != Follow::first && followed != Follow::second;
    Trial trial(simulation, iterations);
    state.iterations = find_enough(trial, iterations, simulation.settings(), may_be_fewer);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::diverged) throw;
  }
  simulation.restore(state);
}

}  // namespace pliant
