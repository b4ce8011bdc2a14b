#include "pliant/solver/factorization/panel_factor.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "pliant/core/stopwatch.h"

namespace pliant {
namespace {

constexpr std::size_t lanes = panel_lanes;

/// Factors smaller than this are swept by one thread: there is less to gain than handing out costs.
constexpr std::size_t min_parallel_entries = 60'000;

std::size_t blocks_of(std::size_t rows) {
  return (rows + lanes - 1) / lanes;
}

std::size_t inverse_size(std::size_t columns) {
  const std::size_t last = blocks_of(columns) - 1;
  return 2 * lanes * last * (last + 1) + lanes * columns;
}

using Dense = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor>;

/// The inverse of the diagonal block, in the order of the panels.
template <class T>
T* write_inverse(const Supernode& s, Real unit, Dense& block, Dense& inverse, T* out) {
  const Index n = s.columns;
  block.setZero(n, n);
  for (Index c = 0; c < n; ++c) std::copy_n(s.column(c), n - c, block.data() + static_cast<std::ptrdiff_t>(c) * n + c);
  inverse.setIdentity(n, n);
  block.template triangularView<Eigen::Lower>().solveInPlace(inverse);
  for (Index first = 0; first < n; first += panel_lanes) {
    for (Index c = 0; c < std::min(n, first + panel_lanes); ++c) {
      for (Index r = first; r < first + panel_lanes; ++r) *out++ = r < n && c <= r ? T(inverse(r, c) * unit) : T(0);
    }
  }
  return out;
}

template <class T>
T* write_below(const Supernode& s, Real unit, T* out) {
  const auto below = static_cast<Index>(s.rows_below.size());
  for (Index first = 0; first < below; first += panel_lanes) {
    const Index count = std::min<Index>(panel_lanes, below - first);
    for (Index c = 0; c < s.columns; ++c) {
      const Real* from = s.column(c) + (s.columns - c) + first;
      for (Index r = 0; r < count; ++r) *out++ = T(from[r] / unit);
      for (Index r = count; r < panel_lanes; ++r) *out++ = T(0);
    }
  }
  return out;
}

/// A power of two about as large as x.
Real power_of_two(Real x) {
  return x > 0 && std::isfinite(x) ? std::ldexp(Real(1), std::ilogb(x)) : 1;
}

}  // namespace

template <class T>
void PanelFactor<T>::clear() {
  permutation_ = {};
  panels_ = {};
  rows_ = {};
  values_ = {};
  tasks_ = rest_ = {};
  outer_rows_ = {};
  x_ = {};
}

template <class T>
void PanelFactor<T>::lay_out(const FactorView& factor) {
  clear();
  permutation_.assign(factor.permutation.begin(), factor.permutation.end());
  lay_out_panels(factor);
  lay_out_parts(factor);
}

template <class T>
void PanelFactor<T>::lay_out_panels(const FactorView& factor) {
  std::size_t row = 0, value = 0;
  Index column = 0;
  panels_.reserve(factor.supernodes.size());
  for (const Supernode& s : factor.supernodes) {
    const std::size_t blocks = blocks_of(s.rows_below.size());
    const auto columns = static_cast<std::size_t>(s.columns);
    panels_.push_back({column, s.columns, static_cast<std::int32_t>(blocks), row, value});
    column += s.columns;
    row += lanes * blocks;
    value += inverse_size(columns) + lanes * blocks * columns;
  }
  rows_.resize(row);
  values_.assign(value, T(0));
}

template <class T>
void PanelFactor<T>::lay_out_parts(const FactorView& factor) {
  std::vector<Index> panel_of_column(permutation_.size());
  std::vector<PanelShape> shapes(panels_.size());
  for (std::size_t p = 0; p < panels_.size(); ++p) {
    const Panel& panel = panels_[p];
    std::fill_n(panel_of_column.begin() + panel.first_column, panel.columns, static_cast<Index>(p));
    const std::size_t end = p + 1 < panels_.size() ? panels_[p + 1].first_value : values_.size();
    shapes[p] = {-1, static_cast<std::int64_t>(end - panel.first_value)};
  }
  for (std::size_t p = 0; p < panels_.size(); ++p) {
    const auto& below = factor.supernodes[p].rows_below;
    if (!below.empty()) shapes[p].parent = panel_of_column[static_cast<std::size_t>(below.front())];
  }
  const auto part_of = [this](std::size_t begin, std::size_t end) {
    Part part{begin, end};
    part.column_begin = static_cast<std::size_t>(panels_[begin].first_column);
    part.column_end = static_cast<std::size_t>(panels_[end - 1].first_column + panels_[end - 1].columns);
    return part;
  };
  std::size_t next = 0;
  for (const PanelTask& task : divide(shapes)) {
    const auto begin = static_cast<std::size_t>(task.begin);
    if (next < begin) rest_.push_back(part_of(next, begin));
    next = static_cast<std::size_t>(task.end);
    tasks_.push_back(part_of(begin, next));
  }
  if (next < panels_.size()) rest_.push_back(part_of(next, panels_.size()));
  std::vector<Index> place_of_row(permutation_.size());
  for (Part& part : tasks_) lay_out_task_rows(factor, part, place_of_row);
  const auto nobodys = static_cast<Index>(permutation_.size() + outer_rows_.size() + tasks_.size());
  for (const Part& part : rest_) lay_out_rows(factor, part, nobodys, [](Index row) { return row; });
  x_.assign(lanes * (static_cast<std::size_t>(nobodys) + 1), T(0));
}

/// Writes the rows of x for the panels of a part: those that `place_of` gives, and one that fills up blocks.
template <class T>
template <class PlaceOf>
void PanelFactor<T>::lay_out_rows(const FactorView& factor, const Part& part, Index nobodys, PlaceOf&& place_of) {
  for (std::size_t p = part.panel_begin; p < part.panel_end; ++p) {
    const auto out = rows_.begin() + static_cast<std::ptrdiff_t>(panels_[p].first_row);
    std::fill_n(out, lanes * static_cast<std::size_t>(panels_[p].row_blocks), nobodys);
    std::ranges::transform(factor.supernodes[p].rows_below, out, place_of);
  }
}

template <class T>
void PanelFactor<T>::lay_out_task_rows(const FactorView& factor, Part& part, std::vector<Index>& place_of_row) {
  const auto end = static_cast<Index>(part.column_end);
  part.outer_begin = outer_rows_.size();
  for (std::size_t p = part.panel_begin; p < part.panel_end; ++p) {
    const auto& below = factor.supernodes[p].rows_below;
    outer_rows_.insert(outer_rows_.end(), std::ranges::lower_bound(below, end), below.end());
  }
  const auto first = outer_rows_.begin() + static_cast<std::ptrdiff_t>(part.outer_begin);
  std::sort(first, outer_rows_.end());
  outer_rows_.erase(std::unique(first, outer_rows_.end()), outer_rows_.end());
  part.outer_end = outer_rows_.size();
  const auto tasks_before = static_cast<std::size_t>(&part - tasks_.data());
  part.own_rows = permutation_.size() + part.outer_begin + tasks_before;
  for (std::size_t k = part.outer_begin; k < part.outer_end; ++k) {
    place_of_row[static_cast<std::size_t>(outer_rows_[k])] = static_cast<Index>(part.own_rows + k - part.outer_begin);
  }
  const auto nobodys = static_cast<Index>(part.own_rows + part.outer_end - part.outer_begin);
  lay_out_rows(factor, part, nobodys,
               [&](Index row) { return row < end ? row : place_of_row[static_cast<std::size_t>(row)]; });
}

template <class T>
void PanelFactor<T>::fill(const FactorView& factor, Real largest_diagonal) {
  unit_ = power_of_two(std::sqrt(largest_diagonal));
  Dense block, inverse;
  for (std::size_t p = 0; p < panels_.size(); ++p) {
    const Supernode& s = factor.supernodes[p];
    T* out = values_.data() + panels_[p].first_value;
    write_below(s, unit_, write_inverse(s, unit_, block, inverse, out));
  }
}

template <class T>
SolveTimes PanelFactor<T>::solve(const Positions& b, Real scale, Positions& x, ThreadPool& threads) {
  SolveTimes times;
  if (!(scale > 0)) {
    x.setZero();
    return times;
  }
  Stopwatch watch;
  const auto for_each_task = [&](auto&& body) {
    const auto count = static_cast<Index>(tasks_.size());
    const auto run = [&](Index i) { body(tasks_[static_cast<std::size_t>(i)]); };
    if (values_.size() >= min_parallel_entries) {
      threads.parallel_for(count, run);
    } else {
      for (Index i = 0; i < count; ++i) run(i);
    }
  };
  const Real unit = power_of_two(scale);
  for_each_task([&](const Part& part) {
    load(part, b, 1 / unit);
    forward(part);
  });
  for (const Part& part : rest_) load(part, b, 1 / unit);
  for (const Part& part : tasks_) add_outer_rows(part);
  for (const Part& part : rest_) forward(part);
  times.forward = watch.lap();
  const Real factor = unit / (unit_ * unit_);
  for (std::size_t i = rest_.size(); i-- > 0;) backward(rest_[i]);
  for (const Part& part : rest_) store(part, x, factor);
  for_each_task([&](const Part& part) {
    backward(part);
    store(part, x, factor);
  });
  times.backward = watch.lap();
  return times;
}

template <class T>
void PanelFactor<T>::load(const Part& part, const Positions& b, Real factor) {
  for (std::size_t i = part.column_begin; i < part.column_end; ++i) {
    const Real* from = b.data() + 3 * static_cast<std::ptrdiff_t>(permutation_[i]);
    T* to = x_.data() + lanes * i;
    for (std::size_t axis = 0; axis < 3; ++axis) to[axis] = static_cast<T>(from[axis] * factor);
  }
}

template <class T>
void PanelFactor<T>::store(const Part& part, Positions& x, Real factor) const {
  for (std::size_t i = part.column_begin; i < part.column_end; ++i) {
    const T* from = x_.data() + lanes * i;
    Real* to = x.data() + 3 * static_cast<std::ptrdiff_t>(permutation_[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) to[axis] = static_cast<Real>(from[axis]) * factor;
  }
}

template <class T>
void PanelFactor<T>::forward(const Part& part) {
  const std::size_t outer_count = part.outer_end - part.outer_begin;
  if (part.own_rows > 0)
    std::fill_n(x_.begin() + static_cast<std::ptrdiff_t>(lanes * part.own_rows), lanes * outer_count, T(0));
  sweeps_.forward({panels_.data(), rows_.data(), values_.data(), x_.data()}, part.panel_begin, part.panel_end);
}

template <class T>
void PanelFactor<T>::add_outer_rows(const Part& part) {
  const T* from = x_.data() + lanes * part.own_rows;
  for (std::size_t k = part.outer_begin; k < part.outer_end; ++k) {
    T* to = x_.data() + lanes * static_cast<std::size_t>(outer_rows_[k]);
    for (std::size_t lane = 0; lane < lanes; ++lane) to[lane] += *from++;
  }
}

template <class T>
void PanelFactor<T>::backward(const Part& part) {
  T* to = x_.data() + lanes * part.own_rows;
  for (std::size_t k = part.outer_begin; k < part.outer_end; ++k) {
    const T* from = x_.data() + lanes * static_cast<std::size_t>(outer_rows_[k]);
    for (std::size_t lane = 0; lane < lanes; ++lane) *to++ = from[lane];
  }
  sweeps_.backward({panels_.data(), rows_.data(), values_.data(), x_.data()}, part.panel_begin, part.panel_end);
}

template class PanelFactor<float>;
template class PanelFactor<double>;

}  // namespace pliant
