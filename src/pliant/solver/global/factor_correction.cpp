#include "pliant/solver/global/factor_correction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "pliant/core/error.h"

namespace pliant {
namespace {

/// Of the trace.
constexpr Real smallest_shift = 1e-15;
constexpr std::size_t columns_together = 3;
constexpr std::size_t chains = 4;
constexpr std::size_t lanes = panel_lanes;

/// Sums side by side, since one alone would wait for itself.
template <class T, std::size_t width>
using Sums = std::array<std::array<T, width>, chains>;

/// Numbers z times vectors of as many lanes as `sums` are wide.
template <class T, std::size_t width>
void add_products(const T* z, const T* vectors, std::size_t count, Sums<T, width>& sums) {
  std::size_t k = 0;
  for (; k + chains <= count; k += chains) {
    for (std::size_t chain = 0; chain < chains; ++chain) {
      for (std::size_t lane = 0; lane < width; ++lane) {
        sums[chain][lane] += z[k + chain] * vectors[width * (k + chain) + lane];
      }
    }
  }
  for (std::size_t chain = 0; k < count; ++k, ++chain) {
    for (std::size_t lane = 0; lane < width; ++lane) sums[chain][lane] += z[k] * vectors[width * k + lane];
  }
}

template <class T, std::size_t width>
std::array<T, width> total(const Sums<T, width>& sums) {
  std::array<T, width> sum{};
  for (std::size_t lane = 0; lane < width; ++lane) {
    sum[lane] = (sums[0][lane] + sums[1][lane]) + (sums[2][lane] + sums[3][lane]);
  }
  return sum;
}

[[noreturn]] void fail_too_stiff() {
  fail_input("a drag or pin is too stiff, or what it pulls at too soft, for numbers of 64 bits; reduce its stiffness");
}

}  // namespace

void FactorRows::clear() {
  starts.assign(1, 0);
  vertices.clear();
  coefficients.clear();
  weights.clear();
  holds.clear();
}

void FactorRows::add(std::span<const Index> of_vertices, std::span<const Real> of_coefficients, Real weight) {
  if (of_vertices.empty()) return;
  for (std::size_t i = 0; i < count(); ++i) {
    const std::size_t size = starts[i + 1] - starts[i];
    if (std::ranges::equal(of_vertices, std::span(vertices).subspan(starts[i], size)) &&
        std::ranges::equal(of_coefficients, std::span(coefficients).subspan(starts[i], size))) {
      weights[i] += weight;
      return;
    }
  }
  vertices.insert(vertices.end(), of_vertices.begin(), of_vertices.end());
  coefficients.insert(coefficients.end(), of_coefficients.begin(), of_coefficients.end());
  starts.push_back(vertices.size());
  weights.push_back(weight);
  holds.push_back(0);
}

void FactorRows::hold(Index vertex) {
  vertices.push_back(vertex);
  coefficients.push_back(1);
  starts.push_back(vertices.size());
  weights.push_back(1);
  holds.push_back(1);
}

void FactorRows::add_to_diagonal(std::span<Real> diagonal) const {
  for (std::size_t i = 0; i < count(); ++i) {
    for (std::size_t e = starts[i]; e < starts[i + 1] && holds[i] == 0; ++e) {
      diagonal[at(vertices[e])] += weights[i] * coefficients[e] * coefficients[e];
    }
  }
}

void FactorCorrection::set(FactorRows rows, const FreeInFactor& free) {
  rows_ = std::move(rows);
  vector_size_ = free.weights.size();
  find_free(free);
  before_.resize(rows_.vertices.size());
  held_.reserve(rows_.count());
  dots_.resize(column_count());
  starts_.assign(1, {});
  runs_.clear();
  columns_ = {};
}

void FactorCorrection::find_free(const FreeInFactor& free) {
  free_.clear();
  for (std::size_t c = 0; c < free.components.count(); ++c) {
    const std::span<const Index> vertices = free.components.component(c);
    const auto is_here = [&](Index v) { return std::ranges::binary_search(vertices, v); };
    if (std::ranges::none_of(rows_.vertices, is_here)) continue;
    Free found{c, 0, std::vector<Real>(rows_.count()), std::vector<Real>(rows_.count())};
    for (std::size_t i = 0; i < rows_.count(); ++i) {
      for (std::size_t e = rows_.starts[i]; e < rows_.starts[i + 1]; ++e) {
        if (is_here(rows_.vertices[e])) found.shares[i] += rows_.coefficients[e];
      }
    }
    for (const Index v : vertices) found.weight += free.weights[at(v)];
    free_.push_back(std::move(found));
  }
}

Real FactorCorrection::write_columns(std::size_t first, const FreeInFactor& free, Positions& b) const {
  b.setZero();
  for (std::size_t j = 0; j < std::min(columns_together, column_count() - first); ++j) {
    const std::size_t column = first + j;
    const auto axis = static_cast<Eigen::Index>(j);
    if (column < rows_.count()) {
      for (std::size_t e = rows_.starts[column]; e < rows_.starts[column + 1]; ++e) {
        b(rows_.vertices[e], axis) += rows_.coefficients[e];
      }
    } else {
      const std::size_t component = free_[column - rows_.count()].component;
      for (const Index v : free.components.component(component)) b(v, axis) = free.weights[at(v)];
    }
  }
  return b.cwiseAbs().maxCoeff();
}

template <class T>
void FactorCorrection::read_columns(std::size_t first, const InFactorOrder<T>& z, const InFactorOrder<T>& v) {
  for (std::size_t j = 0; j < std::min(columns_together, column_count() - first); ++j) {
    bool goes_on = false;
    for (std::size_t i = 0; lanes * i < v.numbers.size(); ++i) {
      const T of_z = z.numbers[lanes * i + j];
      const T of_v = v.numbers[lanes * i + j];
      const bool is_zero = of_z == 0 && of_v == 0;
      if (!is_zero) {
        if (!goes_on) runs_.push_back({i, 0});
        ++runs_.back().count;
        columns_.z.push_back(static_cast<Real>(of_z) * z.scale);
        columns_.v.push_back(static_cast<Real>(of_v) * v.scale);
      }
      goes_on = !is_zero;
    }
    starts_.push_back({runs_.size(), columns_.z.size()});
  }
}

/// body(where the values begin, where the vector begins, count).
template <class Body>
void FactorCorrection::for_each_run(std::size_t column, Body&& body) const {
  std::size_t value = starts_[column].value;
  for (std::size_t r = starts_[column].run; r < starts_[column + 1].run; ++r) {
    body(value, runs_[r].place, runs_[r].count);
    value += runs_[r].count;
  }
}

/// Of column i of Z and a whole vector.
Real FactorCorrection::product(std::size_t i, std::span<const Real> whole) const {
  Sums<Real, 1> sums{};
  for_each_run(i, [&](std::size_t value, std::size_t place, std::size_t count) {
    add_products(columns_.z.data() + value, whole.data() + place, count, sums);
  });
  return total(sums)[0];
}

/// A Y⁻¹ Aᵀ = Zᵀ V, and what translations of free components add to it.
void FactorCorrection::multiply_columns() {
  const auto count = static_cast<Eigen::Index>(rows_.count());
  meeting_.resize(count, count);
  std::vector<Real> whole(vector_size_);
  for (std::size_t j = 0; j < rows_.count(); ++j) {
    for_each_run(j, [&](std::size_t value, std::size_t place, std::size_t run) {
      std::copy_n(columns_.v.data() + value, run, whole.data() + place);
    });
    const auto column = static_cast<Eigen::Index>(j);
    for (std::size_t i = 0; i <= j; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      meeting_(row, column) = meeting_(column, row) = product(i, whole);
    }
    for (std::size_t c = 0; c < free_.size(); ++c) {
      free_[c].missing[j] = (free_[c].shares[j] - product(rows_.count() + c, whole)) / free_[c].weight;
    }
    for_each_run(
        j, [&](std::size_t, std::size_t place, std::size_t run) { std::fill_n(whole.data() + place, run, Real(0)); });
  }
  for (const Free& free : free_) {
    const Eigen::Map<const Eigen::VectorX<Real>> shares(free.shares.data(), count), missing(free.missing.data(), count);
    meeting_ += (shares * missing.transpose() + missing * shares.transpose()) / 2;
  }
}

void FactorCorrection::finish_columns() {
  multiply_columns();
  single_.z.assign(columns_.z.begin(), columns_.z.end());
  single_.v.assign(columns_.v.begin(), columns_.v.end());
  set_weights(std::vector<Real>(rows_.weights));
}

void FactorCorrection::set_weights(std::span<const Real> weights) {
  rows_.weights.assign(weights.begin(), weights.end());
  scales_.resize(rows_.count());
  shares_.resize(rows_.count());
  for (std::size_t i = 0; i < rows_.count(); ++i) {
    const Real own = meeting_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i));
    const Real more = 1 + weights[i] * own;
    scales_[i] = rows_.holds[i] != 0 ? 1 / std::sqrt(own) : std::sqrt(weights[i] / more);
    shares_[i] = rows_.holds[i] != 0 ? 0 : 1 / std::sqrt(weights[i] * more);
    if (!std::isfinite(more) || !std::isfinite(scales_[i]) || !std::isfinite(shares_[i])) fail_too_stiff();
  }
  scaled_ = meeting_;
  for (Eigen::Index j = 0; j < scaled_.cols(); ++j) {
    for (Eigen::Index i = 0; i < scaled_.rows(); ++i) {
      scaled_(i, j) *= scales_[static_cast<std::size_t>(i)] * scales_[static_cast<std::size_t>(j)];
    }
    scaled_(j, j) = 1;
  }
  if (!scaled_.allFinite()) fail_too_stiff();
  // Of rows that are nearly the same, as of four drags on one triangle, A Y⁻¹ Aᵀ may have lost the difference to
  // rounding. What is added there takes a share of forces that move next to nothing.
  const Real trace = static_cast<Real>(rows_.count());
  solver_.compute(scaled_);
  for (Real added = smallest_shift; solver_.info() != Eigen::Success; added *= 10) {
    scaled_.diagonal().setConstant(1 + added * trace);
    solver_.compute(scaled_);
  }
}

Vec3 FactorCorrection::times(std::size_t row, const Positions& x) const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t e = rows_.starts[row]; e < rows_.starts[row + 1]; ++e) {
    sum += rows_.coefficients[e] * x.row(rows_.vertices[e]).transpose();
  }
  return sum;
}

/// Row after row: any f will do.
void FactorCorrection::take_out(Positions& r, const Positions* x) {
  held_.clear();
  for (std::size_t i = 0; i < rows_.count(); ++i) {
    if (rows_.holds[i] == 0) continue;
    held_.push_back(x == nullptr ? Vec3(Vec3::Zero()) : Vec3(x->row(rows_.vertices[rows_.starts[i]])));
  }
  for (std::size_t e = 0; e < rows_.vertices.size(); ++e) before_[e] = r.row(rows_.vertices[e]).transpose();
  taken_.resize(static_cast<Eigen::Index>(rows_.count()), 3);
  for (std::size_t i = 0; i < rows_.count(); ++i) {
    Real square = 0;
    for (std::size_t e = rows_.starts[i]; e < rows_.starts[i + 1]; ++e)
      square += rows_.coefficients[e] * rows_.coefficients[e];
    const Vec3 force = square > 0 ? Vec3(times(i, r) / square) : Vec3(Vec3::Zero());
    taken_.row(static_cast<Eigen::Index>(i)) = force.transpose();
    for (std::size_t e = rows_.starts[i]; e < rows_.starts[i + 1]; ++e) {
      r.row(rows_.vertices[e]) -= rows_.coefficients[e] * force.transpose();
    }
  }
}

template <class T>
const FactorCorrection::Columns<T>& FactorCorrection::columns() const {
  if constexpr (std::is_same_v<T, float>) {
    return single_;
  } else {
    return columns_;
  }
}

/// Of column c of Z and y.
template <class T>
Vec3 FactorCorrection::dot(std::size_t c, const InFactorOrder<T>& y) const {
  Sums<T, lanes> sums{};
  for_each_run(c, [&](std::size_t value, std::size_t place, std::size_t count) {
    add_products(columns<T>().z.data() + value, y.numbers.data() + lanes * place, count, sums);
  });
  const std::array<T, lanes> sum = total(sums);
  return y.scale * Vec3(static_cast<Real>(sum[0]), static_cast<Real>(sum[1]), static_cast<Real>(sum[2]));
}

/// y ← y + (column i of V) μᵢ.
template <class T>
void FactorCorrection::add_column(std::size_t i, const InFactorOrder<T>& y) const {
  std::array<T, lanes> force{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    force[axis] = static_cast<T>(forces_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(axis)) / y.scale);
  }
  for_each_run(i, [&](std::size_t value, std::size_t place, std::size_t count) {
    const T* const v = columns<T>().v.data() + value;
    T* const to = y.numbers.data() + lanes * place;
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t lane = 0; lane < lanes; ++lane) to[lanes * k + lane] += v[k] * force[lane];
    }
  });
}

template <class T>
void FactorCorrection::correct(const InFactorOrder<T>& y, const Positions& r, const Components& free_components) {
  for (std::size_t c = 0; c < dots_.size(); ++c) dots_[c] = dot(c, y);
  for (std::size_t c = 0; c < free_.size(); ++c) {
    Vec3 missing = -dots_[rows_.count() + c];
    for (const Index v : free_components.component(free_[c].component)) missing += r.row(v).transpose();
    missing /= free_[c].weight;
    for (std::size_t i = 0; i < rows_.count(); ++i) dots_[i] += free_[c].shares[i] * missing;
  }
  find_forces();
  for (std::size_t i = 0; i < rows_.count(); ++i) add_column(i, y);
}

/// μ, given A Y⁻¹ r₀ in dots_.
void FactorCorrection::find_forces() {
  forces_.resize(static_cast<Eigen::Index>(rows_.count()), 3);
  for (std::size_t i = 0; i < rows_.count(); ++i) {
    const auto line = static_cast<Eigen::Index>(i);
    forces_.row(line) = shares_[i] * taken_.row(line) - scales_[i] * dots_[i].transpose();
  }
  solver_.solveInPlace(forces_);
  for (std::size_t i = 0; i < rows_.count(); ++i) forces_.row(static_cast<Eigen::Index>(i)) *= scales_[i];
}

void FactorCorrection::add_pull(Positions& r) const {
  for (std::size_t i = 0; i < rows_.count(); ++i) {
    for (std::size_t e = rows_.starts[i]; e < rows_.starts[i + 1]; ++e) {
      r.row(rows_.vertices[e]) += rows_.coefficients[e] * forces_.row(static_cast<Eigen::Index>(i));
    }
  }
}

void FactorCorrection::put_back(Positions& r, Positions& x) const {
  for (std::size_t e = 0; e < rows_.vertices.size(); ++e) r.row(rows_.vertices[e]) = before_[e].transpose();
  auto held = held_.begin();
  for (std::size_t i = 0; i < rows_.count(); ++i) {
    if (rows_.holds[i] != 0) x.row(rows_.vertices[rows_.starts[i]]) = (*held++).transpose();
  }
}

template void FactorCorrection::read_columns(std::size_t, const InFactorOrder<float>&, const InFactorOrder<float>&);
template void FactorCorrection::read_columns(std::size_t, const InFactorOrder<Real>&, const InFactorOrder<Real>&);
template void FactorCorrection::correct(const InFactorOrder<float>&, const Positions&, const Components&);
template void FactorCorrection::correct(const InFactorOrder<Real>&, const Positions&, const Components&);

}  // namespace pliant
