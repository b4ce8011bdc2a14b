#include "pliant/solver/integration/energy_balance.h"

#include <algorithm>
#include <cmath>

#include "pliant/solver/component_loops.h"

namespace pliant {
namespace {

/// Amplitudes are changed by no more than these in one step. What cannot be given back is of vibrations far too fast
/// for the step, and better lost than given to others. What there is too much after few iterations is not taken at
/// once, which would brake, but kept from what later steps would be given.
constexpr Real least_factor = 0.98;
constexpr Real largest_factor = 2;
/// But a kinetic energy that alone is more than T + V should be is too much for certain, as BDF2 leaves it where a cord
/// goes taut. That is taken at once, down to this factor of the velocities.
constexpr Real hardest_brake = 0.5;

/// Shares of an energy that are rounding.
constexpr Real rounding = 1e-13;

/// x with square·(x² − 1) + linear·(x − 1) = missing, as far as it may go; 1 where that is rounding, or no number.
Real factor_of(Real square, Real linear, Real missing, Real noise, Real least = least_factor) {
  const Real slope = 2 * square + linear;  // at 1
  if (!(std::abs(missing) > noise)) return 1;
  const Real root = std::sqrt(std::max(Real(0), slope * slope + 4 * square * missing));
  const Real factor = 1 + 2 * missing / (slope + root);
  return slope > 0 && !std::isnan(factor) ? std::clamp(factor, least, largest_factor) : 1;
}

/// By what velocities may be scaled at least: to `allowed` [J], where their kinetic energy is more.
Real least_velocity_factor(Real kinetic, Real allowed) {
  if (!(allowed < least_factor * least_factor * kinetic)) return least_factor;
  return std::max(hardest_brake, std::sqrt(std::max(Real(0), allowed) / kinetic));
}

/// Of a turning with that angular momentum [J].
Real turning_energy(const Mat3& inertia, const Vec3& angular_momentum) {
  return angular_velocity(inertia, angular_momentum).dot(angular_momentum) / 2;
}

/// Of a move: fᵀ x, and that less what inertia has of it.
struct AlongMove {
  Real slope = 0;
  Real curvature = 0;
  AlongMove& operator+=(const AlongMove& other) {
    slope += other.slope;
    curvature += other.curvature;
    return *this;
  }
};

}  // namespace

void EnergyBalance::set_components(Components components, const Components& free_components,
                                   std::span<const char> is_pinned) {
  components_ = std::move(components);
  is_pinned_.assign(is_pinned.begin(), is_pinned.end());
  const std::vector<Index> owners = component_of_vertex(components_);
  is_free_.assign(components_.count(), 0);
  for (std::size_t i = 0; i < free_components.count(); ++i) {
    is_free_[at(owners[at(free_components.component(i).front())])] = 1;
  }
  accounts_.resize(components_.count());
}

/// All zero where something holds the component.
RigidMotion EnergyBalance::rigid_motion(std::size_t component, const Positions& positions, const Positions& velocities,
                                        ThreadPool* inside) const {
  if (!is_free_[component]) return {};
  return fit_rigid_motion(components_.component(component), positions, masses_, velocities, inside);
}

/// Σ m/2 ‖v − v_rigid‖² [J]
Real EnergyBalance::non_rigid_energy(std::size_t component, const RigidMotion& rigid, const Positions& positions,
                                     const Positions& velocities, ThreadPool* inside) const {
  return sum_over<Real>(components_.component(component), inside, [&](Real& sum, Index v) {
    if (is_pinned_[at(v)]) return;
    sum += masses_[at(v)] / 2 * (row(velocities, v) - rigid.velocity_at(row(positions, v))).squaredNorm();
  });
}

void EnergyBalance::begin(const StepEnd& begin, std::span<const Real> masses, std::span<const Real> surplus,
                          ThreadPool& threads) {
  threads_ = &threads;
  masses_ = masses;
  positions_ = begin.positions;
  velocities_ = begin.velocities;
  elastic_forces_ = begin.elastic_forces;
  for_each_component(components_, threads,
                     [&](std::size_t p, ThreadPool* inside) { begin_component(p, begin, surplus, inside); });
}

void EnergyBalance::begin_component(std::size_t component, const StepEnd& begin, std::span<const Real> surplus,
                                    ThreadPool* inside) {
  const RigidMotion rigid = rigid_motion(component, positions_, velocities_, inside);
  Account& account = accounts_[component];
  account.target = begin.elastic[component] + non_rigid_energy(component, rigid, positions_, velocities_, inside) +
                   turning_energy(rigid.inertia, rigid.angular_momentum);
  account.center = rigid.center;
  account.velocity = rigid.velocity;
  account.angular_momentum = rigid.angular_momentum;
  account.surplus = 0;
  for (const Index v : components_.component(component)) account.surplus += surplus.empty() ? 0 : surplus[at(v)];
}

void EnergyBalance::balance(const StepEnd& end, const Positions& outside, Real h, Real share, Positions& forces) {
  for_each_component(components_, *threads_, [&](std::size_t p, ThreadPool* inside) {
    balance_component(p, end, outside, h, share, inside);
    write_forces(p, end, outside, forces, inside);
  });
}

EnergyBalance::Work EnergyBalance::outside_work(std::size_t component, const RigidMotion& rigid, const StepEnd& end,
                                                const Positions& outside, ThreadPool* inside) const {
  const Account& account = accounts_[component];
  const Vec3 shift = rigid.center - account.center;
  return sum_over<Work>(components_.component(component), inside, [&](Work& work, Index v) {
    const Vec3 displacement = row(end.positions, v) - row(positions_, v);
    if (is_pinned_[at(v)]) {
      work.add(-(row(elastic_forces_, v) + row(end.elastic_forces, v)).dot(displacement) / 2);
      return;
    }
    const Vec3 force = row(outside, v);
    work.add(force.dot(displacement - shift));
    if (!is_free_[component]) return;
    const Vec3 arm = (row(positions_, v) + row(end.positions, v) - account.center - rigid.center) / 2;
    work.torque += arm.cross(force);
  });
}

void EnergyBalance::balance_component(std::size_t component, const StepEnd& end, const Positions& outside, Real h,
                                      Real share, ThreadPool* inside) {
  const RigidMotion rigid = rigid_motion(component, end.positions, end.velocities, inside);
  const Work work = outside_work(component, rigid, end, outside, inside);
  const Real energy = end.elastic[component] +
                      non_rigid_energy(component, rigid, end.positions, end.velocities, inside) +
                      turning_energy(rigid.inertia, rigid.angular_momentum);
  Account& account = accounts_[component];
  account.noise = rounding * (account.target + work.size + energy);
  const Real missing = account.target + work.sum - energy;
  const Real owed = missing > 0 ? std::min(missing, account.surplus) : 0;
  account.surplus -= owed;
  account.elastic = end.elastic[component];
  account.work = work.sum;
  account.target = energy + share * (missing - owed);
  account.angular_momentum =
      rigid.angular_momentum + share * (account.angular_momentum + h * work.torque - rigid.angular_momentum);
}

/// Of a component that nothing holds, less what moves it as a whole.
void EnergyBalance::write_forces(std::size_t component, const StepEnd& end, const Positions& outside, Positions& forces,
                                 ThreadPool* inside) const {
  const std::span<const Index> vertices = components_.component(component);
  const auto force_on = [&](Index v) { return Vec3(row(end.elastic_forces, v) + row(outside, v)); };
  Vec3 acceleration = Vec3::Zero();
  if (is_free_[component]) {
    const auto pull = sum_over<MeanSum>(vertices, inside, [&](MeanSum& sum, Index v) {
      sum.vector += force_on(v);
      sum.weight += masses_[at(v)];
    });
    acceleration = pull.mean();
  }
  for_each_vertex(vertices, inside, [&](Index v) {
    const Vec3 force = force_on(v) - masses_[at(v)] * acceleration;
    forces.row(v) = (is_pinned_[at(v)] ? Vec3(Vec3::Zero()) : force).transpose();
  });
}

/// The angular momentum that a component should have, or as near to it as its energy allows.
Vec3 EnergyBalance::allowed_momentum(std::size_t component, const RigidMotion& rigid, Real elastic, Real scaled) const {
  const Account& account = accounts_[component];
  const Vec3 change = account.angular_momentum - rigid.angular_momentum;
  const Real room = account.target - elastic - least_factor * least_factor * scaled -
                    turning_energy(rigid.inertia, rigid.angular_momentum);
  const Real square = turning_energy(rigid.inertia, change);
  const Real linear = rigid.turning.dot(change);
  if (square + linear <= room + account.noise) return account.angular_momentum;
  if (!(room > 0)) return rigid.angular_momentum;
  const Real part_of_change = 2 * room / (linear + std::sqrt(linear * linear + 4 * square * room));
  return rigid.angular_momentum + std::min(Real(1), part_of_change) * change;
}

void EnergyBalance::move(const StepEnd& end, const Positions& forces, const Positions& direction,
                         std::span<const Real> weights, Positions& positions) {
  for_each_component(components_, *threads_, [&](std::size_t p, ThreadPool* inside) {
    move_component(p, end, forces, direction, weights, positions, inside);
  });
}

void EnergyBalance::move_component(std::size_t component, const StepEnd& end, const Positions& forces,
                                   const Positions& direction, std::span<const Real> weights, Positions& positions,
                                   ThreadPool* inside) const {
  const std::span<const Index> vertices = components_.component(component);
  const auto along = sum_over<AlongMove>(vertices, inside, [&](AlongMove& sum, Index v) {
    const Real product = row(forces, v).dot(row(direction, v));
    sum.slope += product;
    sum.curvature += product - weights[at(v)] * direction.row(v).squaredNorm();
  });
  const Account& account = accounts_[component];
  const RigidMotion rigid = rigid_motion(component, end.positions, end.velocities, inside);
  const Real scaled = non_rigid_energy(component, rigid, end.positions, end.velocities, inside);
  const Vec3 angular_momentum = allowed_momentum(component, rigid, account.elastic, scaled);
  const Real missing = account.target - account.elastic - scaled - turning_energy(rigid.inertia, angular_momentum);
  // The elastic energy is no steeper along it than a parabola with Y − M/h² as its matrix.
  const Real curvature = std::clamp(along.curvature, Real(0), std::max(Real(0), along.slope));
  const Real excess = factor_of(scaled + curvature / 2, along.slope - curvature, missing, account.noise) - 1;
  if (excess == 0) return;
  for_each_vertex(vertices, inside, [&](Index v) { positions.row(v) -= excess * direction.row(v); });
}

void EnergyBalance::finish(const StepEnd& end, const Positions& outside, Positions& velocities) {
  for_each_component(components_, *threads_,
                     [&](std::size_t p, ThreadPool* inside) { finish_component(p, end, outside, velocities, inside); });
}

void EnergyBalance::finish_component(std::size_t component, const StepEnd& end, const Positions& outside,
                                     Positions& velocities, ThreadPool* inside) {
  Account& account = accounts_[component];
  const RigidMotion rigid = rigid_motion(component, end.positions, end.velocities, inside);
  if (!rigid.turning.allFinite()) return;
  account.target += outside_work(component, rigid, end, outside, inside).sum - account.work;
  const Real scaled = non_rigid_energy(component, rigid, end.positions, end.velocities, inside);
  const Vec3 angular_momentum = allowed_momentum(component, rigid, end.elastic[component], scaled);
  const Vec3 turning = angular_velocity(rigid.inertia, angular_momentum);
  const Real missing = account.target - end.elastic[component] - scaled - turning.dot(angular_momentum) / 2;
  const Real least = least_velocity_factor(scaled, scaled + missing + end.elastic[component]);
  const Real factor = factor_of(scaled, 0, missing, account.noise, least);
  const Real surplus = scaled * (factor * factor - 1) - missing;
  if (surplus > account.noise) account.surplus += surplus;
  for_each_vertex(components_.component(component), inside, [&](Index v) {
    if (is_pinned_[at(v)]) return;
    const Vec3 x = row(end.positions, v);
    const Vec3 vibration = row(end.velocities, v) - rigid.velocity_at(x);
    velocities.row(v) = (rigid.velocity + turning.cross(x - rigid.center) + factor * vibration).transpose();
  });
}

void EnergyBalance::write_surplus(std::span<Real> surplus) const {
  std::ranges::fill(surplus, Real(0));
  for (std::size_t p = 0; p < components_.count(); ++p)
    surplus[at(components_.component(p).front())] = accounts_[p].surplus;
}

}  // namespace pliant
