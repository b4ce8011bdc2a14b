#include "pliant/solver/global/factorization/panel_factor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pliant/core/stopwatch.h"
#include "pliant/solver/global/factorization/diagonal_blocks.h"

namespace pliant {
namespace {

constexpr std::size_t lanes = panel_lanes;

/// Factors smaller than this are swept by one thread: there is less to gain than handing out costs.
constexpr std::size_t min_parallel_entries = 60'000;

/// Panels whose values a thread writes in one go.
constexpr std::size_t panels_together = 8;

std::size_t blocks_of(std::size_t rows) {
  return (rows + lanes - 1) / lanes;
}

/// Values of the diagonal block.
std::size_t diagonal_size(std::size_t columns) {
  if (columns <= static_cast<std::size_t>(most_whole_columns)) return lanes * blocks_of(columns) * columns;
  const std::size_t last = blocks_of(columns) - 1;
  return 2 * lanes * last * (last + 1) + lanes * columns;
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
  diagonal_values_ = 0;
  stages_ = {};
  rest_ = {};
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
    value += diagonal_size(columns) + lanes * blocks * columns;
    diagonal_values_ += diagonal_size(columns);
  }
  rows_.resize(row);
  values_.assign(value, T(0));
}

template <class T>
std::vector<PanelShape> PanelFactor<T>::shapes_of(const FactorView& factor) const {
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
  return shapes;
}

template <class T>
typename PanelFactor<T>::Part PanelFactor<T>::part_of(std::size_t begin, std::size_t end) const {
  const Panel& last = panels_[end - 1];
  return {begin, end, static_cast<std::size_t>(panels_[begin].first_column),
          static_cast<std::size_t>(last.first_column + last.columns)};
}

template <class T>
void PanelFactor<T>::lay_out_parts(const FactorView& factor) {
  std::vector<char> is_in_task(panels_.size(), 0);
  for (const PanelStage& from : divide(shapes_of(factor))) {
    Stage& stage = stages_.emplace_back();
    for (const PanelTask& panels : from) {
      Task& task = stage.emplace_back();
      for (const PanelRange& range : panels.ranges) {
        task.parts.push_back(part_of(static_cast<std::size_t>(range.begin), static_cast<std::size_t>(range.end)));
        std::fill(is_in_task.begin() + range.begin, is_in_task.begin() + range.end, char{1});
      }
      task.column_end = static_cast<Index>(task.parts.back().column_end);
    }
  }
  for (std::size_t begin = 0, end; begin < panels_.size(); begin = end) {
    for (end = begin; end < panels_.size() && is_in_task[end] == is_in_task[begin];) ++end;
    if (!is_in_task[begin]) rest_.push_back(part_of(begin, end));
  }
  std::vector<Index> place_of_row(permutation_.size());
  std::size_t tasks = 0;
  for (Stage& stage : stages_) {
    for (Task& task : stage) lay_out_task_rows(factor, task, tasks++, place_of_row);
  }
  const auto nobodys = static_cast<Index>(permutation_.size() + outer_rows_.size() + tasks);
  for (const Part& part : rest_) lay_out_rows(factor, part, nobodys, [](Index row) { return row; });
  x_.assign(lanes * (static_cast<std::size_t>(nobodys) + 1), T(0));
}

template <class T>
Index PanelFactor<T>::task_count() const {
  std::size_t count = 0;
  for (const Stage& stage : stages_) count += stage.size();
  return static_cast<Index>(count);
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
void PanelFactor<T>::lay_out_task_rows(const FactorView& factor, Task& task, std::size_t tasks_before,
                                       std::vector<Index>& place_of_row) {
  const Index end = task.column_end;
  task.outer_begin = outer_rows_.size();
  for (const Part& part : task.parts) {
    for (std::size_t p = part.panel_begin; p < part.panel_end; ++p) {
      const auto& below = factor.supernodes[p].rows_below;
      outer_rows_.insert(outer_rows_.end(), std::ranges::lower_bound(below, end), below.end());
    }
  }
  const auto first = outer_rows_.begin() + static_cast<std::ptrdiff_t>(task.outer_begin);
  std::sort(first, outer_rows_.end());
  outer_rows_.erase(std::unique(first, outer_rows_.end()), outer_rows_.end());
  task.outer_end = outer_rows_.size();
  task.own_rows = permutation_.size() + task.outer_begin + tasks_before;
  for (std::size_t k = task.outer_begin; k < task.outer_end; ++k) {
    place_of_row[static_cast<std::size_t>(outer_rows_[k])] = static_cast<Index>(task.own_rows + k - task.outer_begin);
  }
  const auto nobodys = static_cast<Index>(task.own_rows + task.outer_end - task.outer_begin);
  const auto place_of = [&](Index row) { return row < end ? row : place_of_row[static_cast<std::size_t>(row)]; };
  for (const Part& part : task.parts) lay_out_rows(factor, part, nobodys, place_of);
}

template <class T>
void PanelFactor<T>::fill(const FactorView& factor, Real largest_diagonal, ThreadPool& threads) {
  unit_ = power_of_two(std::sqrt(largest_diagonal));
  std::vector<std::vector<Real>> work(static_cast<std::size_t>(threads.thread_count()));
  // From the last panels, the largest, down: those who begin with smaller ones help with them.
  const auto runs = static_cast<Index>((panels_.size() + panels_together - 1) / panels_together);
  threads.parallel_for(runs, [&](Index run, int thread) {
    const std::size_t begin = panels_together * static_cast<std::size_t>(runs - 1 - run);
    for (std::size_t p = begin; p < std::min(panels_.size(), begin + panels_together); ++p) {
      const Supernode& s = factor.supernodes[p];
      std::vector<Real>& room = work[static_cast<std::size_t>(thread)];
      room.resize(std::max(room.size(), panel_work(static_cast<std::size_t>(s.columns))));
      const PanelSource source{s.values, s.columns, static_cast<Index>(s.rows_below.size()), s.is_rectangle, unit_};
      triangular_solve_.write_panel(source, room.data(), values_.data() + panels_[p].first_value);
    }
  });
}

template <class T>
SolveTimes PanelFactor<T>::solve(const Positions& b, Real scale, Positions& x, ThreadPool& threads, Store how) {
  if (!(scale > 0)) {
    if (how == Store::over) x.setZero();
    return {};
  }
  SolveTimes times = substitute_forward(b, scale, threads);
  times += substitute_backward(x, threads, how);
  return times;
}

template <class T>
SolveTimes PanelFactor<T>::substitute_forward(const Positions& b, Real scale, ThreadPool& threads) {
  const Stopwatch watch;
  loaded_unit_ = power_of_two(scale);
  const auto load_all = [&](const std::vector<Part>& parts) {
    for (const Part& part : parts) load(part, b, 1 / loaded_unit_);
  };
  for (std::size_t s = 0; s < stages_.size(); ++s) {
    for_each_task(stages_[s], threads, [&](const Task& task) {
      if (s == 0) load_all(task.parts);
      forward(task);
    });
    for (std::size_t later = 1; s == 0 && later < stages_.size(); ++later) {
      for (const Task& task : stages_[later]) load_all(task.parts);
    }
    if (s == 0) load_all(rest_);
    for (const Task& task : stages_[s]) add_outer_rows(task);
  }
  if (stages_.empty()) load_all(rest_);
  for (const Part& part : rest_) triangular_solve_.forward(substitution_data(), part.panel_begin, part.panel_end);
  return {.forward = watch.seconds()};
}

template <class T>
SolveTimes PanelFactor<T>::substitute_backward(Positions& x, ThreadPool& threads, Store how) {
  const Stopwatch watch;
  const Real factor = loaded_unit_ / (unit_ * unit_);
  for (auto part = rest_.rbegin(); part != rest_.rend(); ++part) {
    triangular_solve_.backward(substitution_data(), part->panel_begin, part->panel_end);
  }
  for (const Part& part : rest_) store(part, x, factor, how);
  for (std::size_t s = stages_.size(); s-- > 0;) {
    for_each_task(stages_[s], threads, [&](const Task& task) {
      backward(task);
      for (const Part& part : task.parts) store(part, x, factor, how);
    });
  }
  return {.backward = watch.seconds()};
}

template <class T>
InFactorOrder<T> PanelFactor<T>::substitute_forward_sparse(const Positions& b, Real scale, std::vector<T>& work) {
  loaded_unit_ = power_of_two(scale);
  work.assign(lanes * permutation_.size(), T(0));
  for (const Stage& stage : stages_) {
    for (const Task& task : stage) {
      for (const Part& part : task.parts) load(part, b, 1 / loaded_unit_);
    }
  }
  for (const Part& part : rest_) load(part, b, 1 / loaded_unit_);
  for (const Stage& stage : stages_) {
    for (const Task& task : stage) {
      clear_outer_rows(task);
      for (const Part& part : task.parts) forward_sparse(part, work);
      add_outer_rows(task);
    }
  }
  for (const Part& part : rest_) forward_sparse(part, work);
  return {work, loaded_unit_};
}

/// `before`: what panels have before their diagonal blocks take part.
template <class T>
void PanelFactor<T>::forward_sparse(const Part& part, std::vector<T>& before) {
  for (std::size_t p = part.panel_begin; p < part.panel_end; ++p) {
    const std::size_t begin = lanes * static_cast<std::size_t>(panels_[p].first_column);
    const std::span<const T> columns =
        std::span(x_).subspan(begin, lanes * static_cast<std::size_t>(panels_[p].columns));
    if (std::ranges::all_of(columns, [](T number) { return number == 0; })) continue;
    std::ranges::copy(columns, before.begin() + static_cast<std::ptrdiff_t>(begin));
    triangular_solve_.forward(substitution_data(), p, p + 1);
  }
}

template <class T>
template <class Body>
void PanelFactor<T>::for_each_task(const Stage& stage, ThreadPool& threads, Body&& body) {
  const auto count = static_cast<Index>(stage.size());
  const auto run = [&](Index i) { body(stage[static_cast<std::size_t>(i)]); };
  if (values_.size() >= min_parallel_entries) {
    threads.parallel_for(count, run);
  } else {
    for (Index i = 0; i < count; ++i) run(i);
  }
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
void PanelFactor<T>::store(const Part& part, Positions& x, Real factor, Store how) const {
  for (std::size_t i = part.column_begin; i < part.column_end; ++i) {
    const T* from = x_.data() + lanes * i;
    Real* to = x.data() + 3 * static_cast<std::ptrdiff_t>(permutation_[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Real number = static_cast<Real>(from[axis]) * factor;
      to[axis] = how == Store::over ? number : to[axis] + number;
    }
  }
}

template <class T>
void PanelFactor<T>::clear_outer_rows(const Task& task) {
  const auto own = x_.begin() + static_cast<std::ptrdiff_t>(lanes * task.own_rows);
  std::fill_n(own, lanes * (task.outer_end - task.outer_begin), T(0));
}

template <class T>
void PanelFactor<T>::forward(const Task& task) {
  clear_outer_rows(task);
  for (const Part& part : task.parts) triangular_solve_.forward(substitution_data(), part.panel_begin, part.panel_end);
}

template <class T>
void PanelFactor<T>::add_outer_rows(const Task& task) {
  const T* from = x_.data() + lanes * task.own_rows;
  for (std::size_t k = task.outer_begin; k < task.outer_end; ++k) {
    T* to = x_.data() + lanes * static_cast<std::size_t>(outer_rows_[k]);
    std::array<T, lanes> sum;  // all are read before one is written, so that lanes go together
    for (std::size_t lane = 0; lane < lanes; ++lane) sum[lane] = to[lane] + from[lane];
    std::ranges::copy(sum, to);
    from += lanes;
  }
}

template <class T>
void PanelFactor<T>::backward(const Task& task) {
  T* to = x_.data() + lanes * task.own_rows;
  for (std::size_t k = task.outer_begin; k < task.outer_end; ++k) {
    const T* from = x_.data() + lanes * static_cast<std::size_t>(outer_rows_[k]);
    to = std::copy_n(from, lanes, to);
  }
  for (auto part = task.parts.rbegin(); part != task.parts.rend(); ++part) {
    triangular_solve_.backward(substitution_data(), part->panel_begin, part->panel_end);
  }
}

template class PanelFactor<float>;
template class PanelFactor<double>;

}  // namespace pliant
