#include "bench/xpbd.h"

#include <algorithm>

#include <Eigen/Cholesky>

#include "pliant/constraints/stencil_sum.h"
#include "pliant/core/error.h"

namespace pliant_bench {
namespace {

using namespace pliant;

constexpr int most_rows = 3;

bool can_be_swept(const ConstraintGroup& group) {
  return group.is_projective() && group.shape().rows <= most_rows;
}

}  // namespace

bool Xpbd::takes(const Simulation& simulation) {
  const SolverSettings& settings = simulation.settings();
  if (settings.integrator != Integrator::implicit_euler || settings.substeps != 1) return false;
  if (!simulation.colliders().empty() || simulation.contact().surfaces) return false;
  for (const auto& [id, force] : simulation.forces()) {
    if (!force->groups().empty()) return false;
  }
  return std::ranges::all_of(simulation.groups(), [](const auto& each) {
    return std::ranges::all_of(each.second.set.batches, [](const auto& batch) { return can_be_swept(*batch); });
  });
}

Xpbd::Xpbd(const Simulation& simulation, Multipliers multipliers)
    : kind_(multipliers),
      time_step_(simulation.settings().time_step),
      per_step_squared_(1 / (time_step_ * time_step_)),
      start_(simulation.state()) {
  if (!takes(simulation)) {
    fail_input(
        "XPBD has no contact here, no BDF2, no substeps, no forces that bring constraints, and no constraints "
        "without a projection or with more than " +
        std::to_string(most_rows) + " rows; leave them out");
  }
  for (const double mass : start_.masses) inverse_masses_.push_back(1 / mass);
  const double h = time_step_;
  Positions forces = Positions::Zero(start_.vertex_count(), 3);
  for (const auto& [id, force] : simulation.forces()) force->add_to(forces, start_.view(), h);
  const Eigen::Map<const Eigen::VectorXd> inverse(inverse_masses_.data(), start_.vertex_count());
  prediction_ = start_.positions + h * start_.velocities + h * h * (inverse.asDiagonal() * forces);
  for (const auto& [id, group] : simulation.groups()) {
    for (const auto& batch : group.set.batches) add_group(*batch);
  }
  Index largest = 1;
  for (Block& block : blocks_) {
    largest = std::max<Index>(largest, block.group->shape().vertices);
    if (kind_ == Multipliers::each_row) invert(block);  // now all pins are known
  }
  gradient_.resize(largest, 3);
  begin_step();
}

void Xpbd::add_group(const ConstraintGroup& group) {
  Block block;
  block.group = group.copy();
  if (!block.group) fail_input("XPBD needs copies of constraints, which '" + std::string(group.type()) + "' has not");
  block.group->begin_step(start_.view(), time_step_);
  const std::span<const Index> pinned = block.group->pinned_vertices();
  for (std::size_t i = 0; i < pinned.size(); ++i) {
    inverse_masses_[at(pinned[i])] = 0;
    prediction_.row(pinned[i]) = Eigen::Map<const Eigen::RowVector3d>(block.group->targets().data() + 3 * i);
  }
  const GroupShape shape = group.shape();
  if (shape.count == 0) return;
  for (const double measure : group.rest_measure()) {
    block.inverse_weights.push_back(1 / (group.stiffness() * measure));
  }
  const std::size_t numbers = kind_ == Multipliers::one ? 1 : 3 * static_cast<std::size_t>(shape.rows);
  block.multipliers.resize(numbers * block.inverse_weights.size());
  block.rows = shape.rows;
  block.vertices = static_cast<std::size_t>(shape.vertices);
  block.is_linear = group.is_linear();
  block.stencil = block.group->stencil().data();
  block.reduction = block.group->reduction().data();
  blocks_.push_back(std::move(block));
}

void Xpbd::invert(Block& block) const {
  const std::size_t n = block.vertices, k = static_cast<std::size_t>(block.rows);
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::VectorXd inverse(n);
  for (std::size_t i = 0; i < block.inverse_weights.size(); ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      inverse[static_cast<Index>(j)] = inverse_masses_[at(block.stencil[i * n + j])];
    }
    const Eigen::Map<const Matrix> A(block.reduction + i * n * k, block.rows, static_cast<Index>(n));
    Matrix sum = A * inverse.asDiagonal() * A.transpose();
    sum.diagonal().array() += block.inverse_weights[i] * per_step_squared_;
    const Matrix solved = sum.llt().solve(Matrix::Identity(block.rows, block.rows));
    block.inverses.insert(block.inverses.end(), solved.data(), solved.data() + k * k);
  }
}

void Xpbd::begin_step() {
  positions_ = prediction_;
  for (Block& block : blocks_) std::ranges::fill(block.multipliers, 0.0);
}

void Xpbd::sweep() {
  for (Block& block : blocks_) {
    switch (block.rows) {
      case 1:
        sweep_over<1>(block);
        break;
      case 2:
        sweep_over<2>(block);
        break;
      default:
        sweep_over<most_rows>(block);
    }
  }
}

template <int rows>
void Xpbd::sweep_over(Block& block) {
  if (kind_ == Multipliers::one) {
    for (std::size_t i = 0; i < block.inverse_weights.size(); ++i) correct_along_gradient<rows>(block, i);
  } else {
    for (std::size_t i = 0; i < block.inverse_weights.size(); ++i) correct_rows<rows>(block, i);
  }
}

template <int rows>
ZRows<rows> Xpbd::pull_of(const Block& block, std::size_t i) const {
  ZRows<rows> pull;
  const std::size_t n = block.vertices;
  if (block.is_linear) {  // p = 0
    sum_stencil<rows, true>(positions_.data(), {block.stencil + i * n, n}, block.reduction + i * n * rows, pull.data());
    return -pull;
  }
  const auto place = static_cast<Index>(i);
  block.group->project(positions_, {pull.data(), 3 * rows}, place, place + 1);
  return block.inverse_weights[i] * pull;
}

template <int rows>
void Xpbd::correct_along_gradient(Block& block, std::size_t i) {
  const std::size_t n = block.vertices;
  const Index* stencil = block.stencil + i * n;
  const double* A = block.reduction + i * n * rows;
  ZRows<rows> direction = -pull_of<rows>(block, i);
  const double C = direction.norm();
  if (C == 0) return;  // no gradient
  direction *= 1 / C;
  double sum = 0;  // ∇C M⁻¹ ∇Cᵀ
  for (std::size_t j = 0; j < n; ++j) {
    Eigen::RowVector3d gradient = A[j] * direction.row(0);
    for (std::size_t r = 1; r < rows; ++r) gradient += A[r * n + j] * direction.row(static_cast<Index>(r));
    sum += inverse_masses_[at(stencil[j])] * gradient.squaredNorm();
    gradient_.row(static_cast<Index>(j)) = gradient;
  }
  const double compliance = block.inverse_weights[i] * per_step_squared_;
  double& multiplier = block.multipliers[i];
  const double change = -(C + compliance * multiplier) / (sum + compliance);
  multiplier += change;
  for (std::size_t j = 0; j < n; ++j) {
    positions_.row(stencil[j]) += inverse_masses_[at(stencil[j])] * change * gradient_.row(static_cast<Index>(j));
  }
}

template <int rows>
void Xpbd::correct_rows(Block& block, std::size_t i) {
  const std::size_t n = block.vertices;
  const Index* stencil = block.stencil + i * n;
  const double* A = block.reduction + i * n * rows;
  const double compliance = block.inverse_weights[i] * per_step_squared_;
  Eigen::Map<ZRows<rows>> multipliers(block.multipliers.data() + 3 * i * rows);
  const Eigen::Map<const Eigen::Matrix<double, rows, rows>> inverse(block.inverses.data() + i * rows * rows);
  const ZRows<rows> change = inverse * (pull_of<rows>(block, i) - compliance * multipliers);
  multipliers += change;
  for (std::size_t j = 0; j < n; ++j) {
    Eigen::RowVector3d move = A[j] * change.row(0);
    for (std::size_t r = 1; r < rows; ++r) move += A[r * n + j] * change.row(static_cast<Index>(r));
    positions_.row(stencil[j]) += inverse_masses_[at(stencil[j])] * move;
  }
}

}  // namespace pliant_bench
