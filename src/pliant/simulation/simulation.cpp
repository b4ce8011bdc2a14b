#include "pliant/simulation/simulation.h"

#include <cmath>

#include "pliant/core/error.h"
#include "pliant/mesh/geometry.h"
#include "pliant/simulation/divergence_message.h"
#include "pliant/simulation/let_go_message.h"
#include "pliant/simulation/step_error.h"
#include "pliant/simulation/transaction.h"
#include "pliant/solver/solver.h"

namespace pliant {
namespace {

/// Refuses a wrong number of rows and what is not finite.
void check_rows(const Positions& given, Index vertex_count, const std::string& where) {
  if (given.rows() != vertex_count) {
    fail_input(where + ": " + std::to_string(given.rows()) + " rows for " + std::to_string(vertex_count) +
               " vertices; give one row a vertex");
  }
  for (Index i = 0; i < given.rows(); ++i) {
    if (!given.row(i).allFinite()) {
      fail_input(where + "[" + std::to_string(i) + "] is not finite; give three finite numbers");
    }
  }
}

/// `given`, or `fallback` when empty.
Positions given_or(Positions given, const Positions& fallback, std::string_view what, std::string_view name) {
  if (given.size() == 0) return fallback;
  check_rows(given, static_cast<Index>(fallback.rows()), "body '" + std::string(name) + "': " + std::string(what));
  return given;
}

void append(Positions& x, const Positions& more) {
  const Index old_rows = static_cast<Index>(x.rows());
  x.conservativeResize(old_rows + more.rows(), 3);
  x.bottomRows(more.rows()) = more;
}

void check_surplus(const State& state) {
  const auto is_surplus = [](Real energy) { return energy >= 0 && std::isfinite(energy); };
  if (state.energy_surplus.empty()) return;
  if (state.energy_surplus.size() == state.masses.size() && std::ranges::all_of(state.energy_surplus, is_surplus))
    return;
  fail_input(
      "restore: the energy surplus is not one number for each vertex, 0 or more; give a state that state() has "
      "returned");
}

}  // namespace

Simulation::Simulation(const SolverSettings& settings) : solver_(std::make_unique<Solver>(settings)) {
  settings_ = settings;
  state_.positions.resize(0, 3);
  state_.velocities.resize(0, 3);
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

BodyId Simulation::add_body(Mesh mesh, const Mass& mass, BodyOptions options) {
  if (options.name.empty()) options.name = "body " + std::to_string(bodies_.size());
  check_mesh(mesh, options.name);
  const std::vector<Real> masses = vertex_masses(mesh, mass, options.name);
  const Positions start = given_or(std::move(options.start), mesh.vertices, "start positions", options.name);
  const Positions still = Positions::Zero(mesh.vertex_count(), 3);
  const Positions velocities = given_or(std::move(options.velocities), still, "velocities", options.name);

  if (transaction_ != nullptr) transaction_->save_state();
  const Index first_vertex = state_.vertex_count();
  append(state_.positions, start);
  append(state_.velocities, velocities);
  state_.previous_time_step = 0;
  state_.masses.insert(state_.masses.end(), masses.begin(), masses.end());
  if (!state_.energy_surplus.empty()) state_.energy_surplus.resize(state_.masses.size(), 0);
  if (!state_.contact.stiffening.empty()) state_.contact.stiffening.resize(state_.masses.size(), 1);
  if (!state_.contact.in_factor.empty()) state_.contact.in_factor.resize(state_.masses.size(), 0);
  if (!state_.contact.energies.empty()) state_.contact.energies.resize(state_.masses.size(), 0);
  state_.contact.pairs.clear();  // their features have other numbers now
  state_.contact.let_go.is_known = false;
  bodies_.push_back({std::move(options.name), std::move(mesh), first_vertex});
  groups_changed_ = true;
  colliders_changed_ = true;
  surfaces_changed_ = true;
  note_change();
  return BodyId(static_cast<Index>(bodies_.size()) - 1);
}

Index Simulation::vertex(BodyId id, Index vertex_of_body) const {
  const Body& owner = body(id);
  if (vertex_of_body < 0 || vertex_of_body >= owner.mesh.vertex_count()) {
    fail_input("body '" + owner.name + "': vertex " + std::to_string(vertex_of_body) +
               " is out of range; it has vertices 0 to " + std::to_string(owner.mesh.vertex_count() - 1));
  }
  return owner.first_vertex + vertex_of_body;
}

void Simulation::set_settings(const SolverSettings& settings) {
  if (settings.integrator == Integrator::bdf2) {
    for (const auto& [id, force] : forces_) check_under_bdf2(*force);
  }
  check_projection(settings, contact_.surfaces || !colliders_.empty());
  solver_->set_settings(settings);
  const bool new_limits = settings.time_step != settings_.time_step || settings.substeps != settings_.substeps;
  settings_ = settings;
  if (new_limits) check_forces();
}

void Simulation::update_problem() {
  if (bodies_.empty()) fail_input("the simulation has no body; add one before the first step");
  if (masses_changed_) {
    solver_->forget_factor();
    forces_changed_ = true;
  }
  masses_changed_ = false;
  if (groups_changed_) {
    std::vector<ConstraintGroup*> groups;
    for (const auto& [id, owner] : groups_) {
      for (const auto& batch : owner.set.batches) groups.push_back(batch.get());
    }
    for (const auto& [id, force] : forces_) {
      for (ConstraintGroup* group : force->groups()) groups.push_back(group);
    }
    solver_->set_groups(state_.vertex_count(), std::move(groups));
    groups_changed_ = false;
  }
  if (forces_changed_) {
    std::vector<Force*> forces;
    for (const auto& [id, force] : forces_) forces.push_back(force.get());
    solver_->set_forces(std::move(forces));
    check_forces();
    forces_changed_ = false;
  }
  if (colliders_changed_) update_colliders();
}

void Simulation::set_stop(std::function<bool()> stop) {
  solver_->set_stop(std::move(stop));
}

StepReport Simulation::step() {
  const auto iterations = state_.iterations;
  StepReport report;
  try {
    if (settings_.iterations == automatic_iterations && finds_iterations(state_)) find_iterations(*this);
    update_problem();
    report = solver_->step(state_);
  } catch (const Divergence& divergence) {
    state_.iterations = iterations;
    throw Error(ErrorKind::diverged, message_of(divergence.cause(), *this));
  } catch (...) {  // found anew with the next attempt
    state_.iterations = iterations;
    throw;
  }
  add_warnings(report);
  return report;
}

/// Each once.
void Simulation::add_warnings(const StepReport& report) {
  const auto add = [&](const std::string& begin, const std::string& end) {
    const auto is_same = [&](const std::string& warning) { return warning.starts_with(begin); };
    if (std::ranges::none_of(warnings_, is_same)) warnings_.push_back(begin + end);
  };
  if (settings_.precision != solver_->precision()) {
    add("precision: this system is too stiff for its masses and time step to be solved in single precision; ",
        "it is solved in double precision, which is slower");
  }
  for (const LetGoBodies& each : report.contact.let_go_bodies) {
    const LetGoMessage message(each, bodies_);
    add(message.begin, message.end);
  }
}

Evaluation Simulation::evaluate() {
  update_problem();
  Evaluation evaluation = solver_->evaluate(state_);
  for (const auto& [id, force] : forces_) {
    for (const ConstraintGroup* group : force->groups()) evaluation.outside += solver_->elastic_energy(*group);
  }
  evaluation.elastic -= evaluation.outside;
  return evaluation;
}

SystemInfo Simulation::system_info() {
  update_problem();
  return solver_->system_info(state_);
}

Real Simulation::elastic_energy(GroupId id) const {
  Real energy = 0;
  const Group& owner = group(id);
  if (groups_changed_) return 0;  // the solver has not seen these
  for (const auto& batch : owner.set.batches) energy += solver_->elastic_energy(*batch);
  return energy;
}

std::span<const Real> Simulation::objective_history() const {
  return solver_->objective_history();
}

void Simulation::set_state(const Positions& positions, const Positions& velocities) {
  check_rows(positions, state_.vertex_count(), "set_state: positions");
  check_rows(velocities, state_.vertex_count(), "set_state: velocities");
  if (transaction_ != nullptr) transaction_->save_state();
  state_.positions = positions;
  state_.velocities = velocities;
  state_.previous_time_step = 0;
  state_.energy_surplus.clear();
  state_.contact.memory.clear();
  state_.contact.pairs.clear();
  state_.contact.let_go = {};
  state_.contact.stiffening.clear();
  state_.contact.in_factor.clear();
  state_.contact.energies.clear();
  solver_->forget_prediction();
}

void Simulation::restore(const State& state) {
  check_rows(state.positions, state_.vertex_count(), "restore: positions");
  check_rows(state.velocities, state_.vertex_count(), "restore: velocities");
  if (state.masses != state_.masses) fail_input("restore: the masses differ; make the simulation of the same bodies");
  if (state.step < 0 || state.iterations < 0 || state.changed_step < 0 || !std::isfinite(state.time) ||
      !std::isfinite(state.time_excess)) {
    fail_input("restore: step " + std::to_string(state.step) + ", time " + std::to_string(state.time) +
               " s: not a state of a simulation; give one that state() has returned");
  }
  if (!(state.previous_time_step >= 0) || !std::isfinite(state.previous_time_step)) {
    fail_input("restore: the previous time step is " + std::to_string(state.previous_time_step) +
               " s; give a state that state() has returned");
  }
  if (state.previous_time_step > 0) {
    check_rows(state.previous_positions, state_.vertex_count(), "restore: previous positions");
    check_rows(state.previous_velocities, state_.vertex_count(), "restore: previous velocities");
  }
  check_surplus(state);
  check_contact(state.contact);
  if (transaction_ != nullptr) transaction_->save_state();
  state_ = state;
  if (state_.previous_time_step == 0) {
    for (Positions* rows : {&state_.previous_positions, &state_.previous_velocities}) rows->resize(0, 3);
  }
  solver_->forget_prediction();
}

Precision Simulation::precision() const {
  return solver_->precision();
}

Real Simulation::contraction() const {
  return solver_->contraction();
}

std::string_view Simulation::backend() const {
  return solver_->backend();
}

int Simulation::thread_count() const {
  return solver_->thread_count();
}

BodyView Simulation::view(BodyId id) const {
  const Body& owner = body(id);
  return {owner.mesh, state_.positions.middleRows(owner.first_vertex, owner.mesh.vertex_count()), owner.first_vertex,
          owner.name, state_.time};
}

}  // namespace pliant
