#include "pliant/constraints/linear_forces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pliant/constraints/kernels/local_kernels.h"

namespace pliant {
namespace {

/// Entries of C, for each vertex of a constraint, up to which the product takes less time than the constraint.
constexpr std::size_t most_entries = 2;

/// Which constraints each vertex is in, and as which of their vertices: numbers of places in the list of stencils.
struct Places {
  std::vector<std::size_t> offsets;
  std::vector<std::size_t> places;

  Places(std::span<const Index> stencil, Index vertex_count) : offsets(at(vertex_count) + 1), places(stencil.size()) {
    for (const Index vertex : stencil) ++offsets[at(vertex) + 1];
    for (std::size_t v = 1; v < offsets.size(); ++v) offsets[v] += offsets[v - 1];
    std::vector<std::size_t> next(offsets.begin(), offsets.end() - 1);
    for (std::size_t place = 0; place < stencil.size(); ++place) places[next[at(stencil[place])]++] = place;
  }
  std::span<const std::size_t> of(Index vertex) const {
    return std::span(places).subspan(offsets[at(vertex)], offsets[at(vertex) + 1] - offsets[at(vertex)]);
  }
};

struct Entry {
  Index column;
  Real value;
};

/// Row v of C: neighbors in order, each once.
void find_row(const ConstraintGroup& group, Index v, std::span<const std::size_t> places, std::vector<Entry>& row) {
  const auto n = static_cast<std::size_t>(group.shape().vertices);
  const auto k = static_cast<std::size_t>(group.shape().rows);
  row.clear();
  for (const std::size_t place : places) {
    const std::size_t i = place / n;
    const std::span<const Index> stencil = group.stencil().subspan(i * n, n);
    const std::span<const Real> reduction = group.reduction().subspan(i * k * n, k * n);
    for (std::size_t j = 0; j < n; ++j) {
      if (stencil[j] == v) continue;
      Real product = 0;
      for (std::size_t r = 0; r < k; ++r) product += reduction[r * n + place % n] * reduction[r * n + j];
      row.push_back({stencil[j], -group.rest_measure()[i] * product});
    }
  }
  std::ranges::stable_sort(row, {}, &Entry::column);
  std::size_t last = 0;
  for (std::size_t e = 1; e < row.size(); ++e) {
    if (row[e].column == row[last].column) {
      row[last].value += row[e].value;
    } else {
      row[++last] = row[e];
    }
  }
  if (!row.empty()) row.resize(last + 1);
}

/// Whether a force is no more than rounding makes it: of a row with this Σ |C_vu| at x, a neighbor at y.
bool is_rounding(const Vec3& force, Real size, const Vec3& x, const Vec3& y) {
  constexpr Real share = 8 * std::numeric_limits<Real>::epsilon();
  return force.squaredNorm() <= share * share * size * size * (x.squaredNorm() + (y - x).squaredNorm());
}

}  // namespace

LinearForces::Rows LinearForces::add(const ConstraintGroup& group, Index vertex_count) {
  const std::size_t first_row = vertices_.size(), first_entry = columns_.size();
  const std::size_t most = most_entries * group.stencil().size();
  const Places places(group.stencil(), vertex_count);
  std::vector<Entry> row;
  for (Index v = 0; v < vertex_count; ++v) {
    if (places.of(v).empty()) continue;
    find_row(group, v, places.of(v), row);
    Real size = 0;
    for (const auto& [column, value] : row) {
      columns_.push_back(column);
      values_.push_back(value);
      size += std::abs(value);
    }
    sizes_.push_back(size);
    vertices_.push_back(v);
    offsets_.push_back(static_cast<std::uint32_t>(columns_.size()));
    if (columns_.size() - first_entry <= most && columns_.size() <= std::numeric_limits<std::uint32_t>::max()) continue;
    vertices_.resize(first_row);
    offsets_.resize(first_row + 1);
    sizes_.resize(first_row);
    columns_.resize(first_entry);
    values_.resize(first_entry);
    return {};
  }
  return {first_row, vertices_.size(), true};
}

LinearForces::Found LinearForces::run(Real stiffness, const Positions& q, std::size_t begin, std::size_t end,
                                      Real* forces) const {
  const LocalKernels& kernels = fastest_kernels();
  Found found;
  found.energy = kernels.linear_forces({.positions = q.data(),
                                        .vertices = vertices_.data(),
                                        .offsets = offsets_.data(),
                                        .columns = columns_.data(),
                                        .values = values_.data(),
                                        .stiffness = stiffness,
                                        .begin = begin,
                                        .end = end,
                                        .forces = forces});
  for (std::size_t i = begin; i < end && found.is_rounding; ++i) {  // in motion the first row says no
    const Eigen::Map<const Vec3> force(forces + 3 * (i - begin));
    const Vec3 x = row(q, vertices_[i]);
    const Vec3 y = offsets_[i] == offsets_[i + 1] ? x : Vec3(row(q, columns_[offsets_[i]]));
    found.is_rounding = is_rounding(force, stiffness * sizes_[i], x, y);
  }
  return found;
}

/// Of every sixteenth row, times sixteen: what it is for needs no more.
Real LinearForces::magnitude(Real stiffness, const Positions& q, std::size_t begin, std::size_t end) const {
  constexpr std::size_t stride = 16;
  Real sum = 0;
  for (std::size_t i = begin; i < end; i += stride) {
    for (std::uint32_t k = offsets_[i]; k < offsets_[i + 1]; ++k) {
      sum += std::abs(values_[k]) * (q.row(columns_[k]) - q.row(vertices_[i])).squaredNorm();
    }
  }
  return stiffness / 4 * stride * sum;
}

std::size_t LinearForces::bytes() const {
  return std::span(vertices_).size_bytes() + std::span(offsets_).size_bytes() + std::span(columns_).size_bytes() +
         std::span(values_).size_bytes() + std::span(sizes_).size_bytes();
}

}  // namespace pliant
