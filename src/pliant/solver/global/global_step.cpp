#include "pliant/solver/global/global_step.h"

#include <algorithm>
#include <cmath>

#include "pliant/core/stopwatch.h"
#include "pliant/solver/component_loops.h"

namespace pliant {
namespace {

/// Past this, single precision would cost iterations: what a solve gets wrong can be a motion that is soft against the
/// one asked for, and so one that the iterations correct slowly.
constexpr Real largest_contraction = 0.01;
constexpr int power_iterations = 4;

/// y = Y x for three columns.
void multiply(const LowerMatrix& Y, const Positions& x, Positions& y) {
  y.setZero();
  for_each_entry(Y, [&](Index row, Index column, std::size_t e) {
    y.row(row) += Y.values[e] * x.row(column);
    if (row != column) y.row(column) += Y.values[e] * x.row(row);
  });
}

Real largest_diagonal(const LowerMatrix& Y) {
  Real largest = 0;
  for (Index c = 0; c < Y.size(); ++c) {
    largest = std::max(largest, Y.values[static_cast<std::size_t>(Y.column_starts[static_cast<std::size_t>(c)])]);
  }
  return largest;
}

/// One constant, which has every component's constant in it, and two without any order.
void fill_starts(Positions& x) {
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    const auto place = static_cast<Real>(i);
    x(i, 0) = 1;
    x(i, 1) = std::sin(1.3 * place * place + place);
    x(i, 2) = std::cos(0.7 * place) + std::sin(0.001 * place);
  }
}

}  // namespace

void GlobalStep::analyze(const LowerMatrix& matrix) {
  single_.clear();
  double_.clear();
  factorization_->analyze(matrix);
}

void GlobalStep::factorize(const LowerMatrix& matrix, Precision precision, std::span<const Real> weights,
                           const Components& components, ThreadPool& threads, SetUpTimes& times) {
  Stopwatch watch;
  vertex_count_ = matrix.size();
  weights_ = weights;
  components_ = &components;
  correction_.clear();
  if (components.count() > 0) move_.resize(matrix.size(), 3);
  contraction_ = 0;
  factorization_->factorize(matrix);
  times.numeric = watch.lap();
  fill(matrix, precision, threads);
  times.repack = watch.lap();
  if (precision == Precision::double_) return;
  contraction_ = estimate_contraction(matrix, threads);
  times.estimate = watch.lap();
  if (contraction_ <= largest_contraction) return;
  fill(matrix, Precision::double_, threads);
  times.repack += watch.lap();
}

/// The other panels go: both would take half as much memory again.
void GlobalStep::fill(const LowerMatrix& matrix, Precision precision, ThreadPool& threads) {
  const FactorView factor = factorization_->factor();
  const auto fill_one = [&](auto& panels, auto& others) {
    others.clear();
    if (!panels.is_laid_out()) panels.lay_out(factor);
    panels.fill(factor, largest_diagonal(matrix), threads);
  };
  precision_ = precision;
  if (precision == Precision::double_) {
    fill_one(double_, single_);
  } else {
    fill_one(single_, double_);
  }
}

template <class Visit>
auto GlobalStep::visit_panels(Visit&& visit) {
  return precision_ == Precision::double_ ? visit(double_) : visit(single_);
}

bool GlobalStep::correct(const FactorRows& rows) {
  if (rows.has_same_rows(correction_.rows())) {
    const bool is_other = rows.weights != correction_.rows().weights;
    if (is_other) correction_.set_weights(rows.weights);
    return is_other;
  }
  for (Positions* x : {&trial_, &move_}) x->resize(vertex_count_, 3);
  corrected_weights_.assign(weights_.begin(), weights_.end());
  const FreeInFactor free{*components_, corrected_weights_};
  correction_.set(rows, free);
  for (std::size_t first = 0; first < correction_.column_count(); first += 3) {
    const Real largest = correction_.write_columns(first, free, trial_);
    visit_panels([&]<class T>(PanelFactor<T>& panels) {
      std::vector<T> work;
      const InFactorOrder<T> z = panels.substitute_forward_sparse(trial_, largest, work);
      correction_.read_columns(first, z, panels.between());
    });
  }
  correction_.finish_columns();
  return true;
}

SolveTimes GlobalStep::solve_factorized(const Positions& r, Real largest, Positions& x, ThreadPool& threads) {
  const SolveTimes times = visit_panels([&](auto& panels) { return panels.solve(r, largest, x, threads); });
  correct_means(r, x, weights_, threads);
  return times;
}

SolveTimes GlobalStep::solve(Positions& r, Real largest, Positions& x, ThreadPool& threads) {
  if (correction_.is_empty()) return solve_factorized(r, largest, x, threads);
  return solve_corrected(r, largest, x, threads, Store::over);
}

/// Onto x where no component is free alone.
SolveTimes GlobalStep::solve_corrected(Positions& r, Real largest, Positions& x, ThreadPool& threads, Store how) {
  if (!(largest > 0)) {
    if (how == Store::over) x.setZero();
    return {};
  }
  correction_.take_out(r, how == Store::onto ? &x : nullptr);
  const SolveTimes times = visit_panels([&](auto& panels) {
    SolveTimes both = panels.substitute_forward(r, largest, threads);
    correction_.correct(panels.between(), r, *components_);
    both += panels.substitute_backward(x, threads, how);
    return both;
  });
  if (components_->count() > 0) {
    correction_.add_pull(r);
    correct_means(r, x, corrected_weights_, threads);  // others, and x would not be what the rows were solved for
  }
  correction_.put_back(r, x);
  return times;
}

SolveTimes GlobalStep::move(Positions& r, Real largest, Positions& q, ThreadPool& threads) {
  if (components_->count() == 0) {
    if (!correction_.is_empty()) return solve_corrected(r, largest, q, threads, Store::onto);
    return visit_panels([&](auto& panels) { return panels.solve(r, largest, q, threads, Store::onto); });
  }
  const SolveTimes times = solve(r, largest, move_, threads);
  for_each_vertex(vertex_count_, &threads, [&](Index v) { q.row(v) += move_.row(v); });
  return times;
}

/// On a component that nothing holds, Σ w x = Σ r exactly with w = M/h² and what forces' groups add to it, since no
/// constraint resists its translation; the factor alone is not that exact.
void GlobalStep::correct_means(const Positions& r, Positions& x, std::span<const Real> weights,
                               ThreadPool& threads) const {
  for_each_component(*components_, threads, [&](std::size_t i, ThreadPool* inside) {
    const std::span<const Index> component = components_->component(i);
    const auto missing = sum_over<MeanSum>(component, inside, [&](MeanSum& sum, Index v) {
      const Real w = weights[at(v)];
      sum.vector += r.row(v).transpose() - w * x.row(v).transpose();
      sum.weight += w;
    });
    const Vec3 shift = missing.mean();
    for_each_vertex(component, inside, [&](Index v) { x.row(v) += shift.transpose(); });
  });
}

Real GlobalStep::estimate_contraction(const LowerMatrix& matrix, ThreadPool& threads) {
  for (Positions* x : {&trial_, &image_, &solved_}) x->resize(matrix.size(), 3);
  fill_starts(trial_);
  Real largest = 0;
  for (int i = 0; i < power_iterations; ++i) {
    const Vec3 before = trial_.colwise().norm().transpose();
    multiply(matrix, trial_, image_);
    solve_factorized(image_, image_.cwiseAbs().maxCoeff(), solved_, threads);
    trial_ -= solved_;
    const Vec3 after = trial_.colwise().norm().transpose();
    if (!after.allFinite()) return std::numeric_limits<Real>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      if (before[axis] > 0) largest = std::max(largest, after[axis] / before[axis]);
      if (after[axis] > 0) trial_.col(axis) /= after[axis];
    }
  }
  return largest;
}

void GlobalStep::describe(SystemInfo& info) const {
  const auto take = [&info](const auto& panels) {
    info.factor_entries = static_cast<std::int64_t>(panels.entry_count());
    info.supernodes = panels.panel_count();
    info.substitution_bytes = static_cast<std::int64_t>(panels.substitution_bytes());
    info.backward_bytes = static_cast<std::int64_t>(panels.backward_bytes());
  };
  if (precision_ == Precision::double_) {
    take(double_);
  } else {
    take(single_);
  }
  info.precision = precision_;
  info.contraction = contraction_;
}

}  // namespace pliant
