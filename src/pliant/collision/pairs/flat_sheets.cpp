#include "pliant/collision/pairs/flat_sheets.h"

#include <cmath>
#include <limits>

namespace pliant {

using collision::four_of;
using collision::FourFloats;
using collision::larger;
using collision::smaller;

namespace {

/// What single precision may be wrong by, at most: of a distance, and of a number of a derivative.
constexpr float uncertain_distance = 1e-3F;
constexpr float uncertain_derivative = 1e-3F;
/// Numbers of derivatives beyond that are not looked at.
constexpr float most_stretched = 8;

float sum_of(FourFloats x) {
  return x[0] + x[1] + x[2];
}
FourFloats edge_of(const Positions& q, Index from, Index to) {
  const auto number = [&](Index axis) { return static_cast<float>(q(to, axis) - q(from, axis)); };
  return FourFloats{number(0), number(1), number(2), 0};
}
/// Infinite where one of the numbers is too large, or none.
FourFloats checked(FourFloats x) {
  const FourFloats size = x < FourFloats{} ? -x : x;
  return size < four_of(most_stretched) ? x : four_of(std::numeric_limits<float>::infinity());
}

/// Of FᵀF, for four times both columns of F.
FourFloats least_eigenvalues(const std::array<FourFloats, 4>& u, const std::array<FourFloats, 4>& v) {
  const auto [ux, uy, uz] = collision::columns_of(u[0], u[1], u[2], u[3]);
  const auto [vx, vy, vz] = collision::columns_of(v[0], v[1], v[2], v[3]);
  const FourFloats uu = ux * ux + uy * uy + uz * uz, vv = vx * vx + vy * vy + vz * vz;
  const FourFloats uv = ux * vx + uy * vy + uz * vz;
  const FourFloats half = four_of(0.5F) * (uu - vv), squared = half * half + uv * uv;
  std::array<float, 4> roots;
  for (std::size_t i = 0; i < 4; ++i) roots[i] = std::sqrt(squared[i]);
  return four_of(0.5F) * (uu + vv) - collision::four_at(roots.data());
}

}  // namespace

void FlatSheets::Box::add(const Box& other) {
  for (std::size_t i = 0; i < 2; ++i) {
    low[i] = std::min(low[i], other.low[i]);
    high[i] = std::max(high[i], other.high[i]);
  }
  if (other.sheet != sheet) sheet = -1;
}

void FlatSheets::Hull::add(const Hull& other) {
  low = {smaller(low.u, other.low.u), smaller(low.v, other.low.v)};
  high = {larger(high.u, other.high.u), larger(high.v, other.high.v)};
}

FlatSheets::Box FlatSheets::box_of(Index vertex) const {
  if (sheet_of_vertex_[at(vertex)] < 0) return {};
  const Sheet& sheet = sheets_[at(sheet_of_vertex_[at(vertex)])];
  const auto number = [&](std::size_t i) {
    return static_cast<float>(places_[at(vertex)][i] - sheet.origin[i]) * sheet.cells_per_length;
  };
  return Box{{number(0), number(1)}, {number(0), number(1)}, sheet_of_vertex_[at(vertex)]};
}

void FlatSheets::find_spread(const Positions& q, Real distance, ThreadPool& threads) {
  std::ranges::fill(hulls_, Hull{});
  find_hulls(q, threads);
  judge(distance, threads);
}

void FlatSheets::find_spread(const Positions& begin, const Positions& end, Real distance, ThreadPool& threads) {
  std::ranges::fill(hulls_, Hull{});
  find_hulls(begin, threads);
  find_hulls(end, threads);
  judge(distance, threads);
}

/// Adds those of the triangles at q to the hulls of the finest cells.
void FlatSheets::find_hulls(const Positions& q, ThreadPool& threads) {
  const auto in_chunks = [&](Index count, auto&& visit) {
    threads.parallel_for((count + items_of_chunk - 1) / items_of_chunk, [&](Index chunk) {
      const Index end = std::min(count, (chunk + 1) * items_of_chunk);
      for (Index i = chunk * items_of_chunk; i < end; ++i) visit(i);
    });
  };
  const Index count = count_of(triangles_);
  in_chunks((count + 3) / 4, [&](Index four) {
    std::array<FourFloats, 4> u, v;
    for (Index i = 0; i < 4; ++i) {
      const auto& [vertices, inverse] = triangles_[at(std::min(4 * four + i, count - 1))];
      const FourFloats first = edge_of(q, vertices[0], vertices[1]), second = edge_of(q, vertices[0], vertices[2]);
      u[at(i)] = checked(first * four_of(inverse[0]) + second * four_of(inverse[2]));
      v[at(i)] = checked(first * four_of(inverse[1]) + second * four_of(inverse[3]));
    }
    const FourFloats least = least_eigenvalues(u, v);
    for (Index i = 0; i < std::min<Index>(4, count - 4 * four); ++i) {
      u[at(i)][3] = least[i];
      derivatives_[at(4 * four + i)] = {u[at(i)], v[at(i)]};
    }
  });
  in_chunks(first_cells_, [&](Index cell) {
    Hull hull = hulls_[at(cell)];
    for (Index i = cell_begin_[at(cell)]; i < cell_begin_[at(cell) + 1]; ++i) {
      const Derivative& each = derivatives_[at(cell_triangles_[at(i)])];
      hull.add({each, each});
    }
    hulls_[at(cell)] = hull;
  });
}

void FlatSheets::judge(Real distance, ThreadPool& threads) {
  for (const Sheet& sheet : sheets_) {
    for (Index level = 0; level < sheet.level_count; ++level) {
      judge(sheet, level, static_cast<float>(distance), threads);
    }
  }
}

void FlatSheets::judge(const Sheet& sheet, Index level, float distance, ThreadPool& threads) {
  const auto for_each_in_rows = [&](auto&& visit) {
    threads.parallel_for(sheet.rows[at(level)], [&](Index row) {
      for (Index column = 0; column < sheet.columns[at(level)]; ++column) {
        visit(sheet.cell(level, column, row), column, row);
      }
    });
  };
  const auto hull_of = [&](const std::vector<Hull>& hulls, Index of_level, Index column, Index row, Index columns,
                           Index rows) {
    Hull hull;
    for_each_of(sheet, of_level, column, row, columns, rows, [&](Index cell) { hull.add(hulls[at(cell)]); });
    return hull;
  };
  if (level > 0) {
    for_each_in_rows([&](Index cell, Index column, Index row) {
      hulls_[at(cell)] = hull_of(hulls_, level - 1, 2 * column, 2 * row, 2, 2);
    });
  }
  for_each_in_rows([&](Index cell, Index column, Index row) {
    side_by_side_[at(cell)] = hull_of(hulls_, level, column, row, block, 1);
  });
  for_each_in_rows([&](Index cell, Index column, Index row) {
    const float needed = distance / nearest_[at(cell)] * (1 + uncertain_distance) + uncertain_derivative;
    are_spread_[at(cell)] =
        needed < 1 && least_eigenvalue(hull_of(side_by_side_, level, column, row, 1, block)) > needed ? 1 : 0;
  });
}

/// λ; no number or −∞ where something is not finite, or there is no triangle.
float FlatSheets::least_eigenvalue(const Hull& hull) {
  const FourFloats half = four_of(0.5F);
  const FourFloats u = half * hull.low.u + half * hull.high.u, v = half * hull.low.v + half * hull.high.v;
  // F of the middle = (a b) (l s; 0 h) with directions a, b across each other; R is (a b), turned to where RᵀF is
  // symmetric.
  const float l = std::sqrt(sum_of(u * u));
  const FourFloats a = u * four_of(1 / l);
  const float s = sum_of(a * v);
  const FourFloats rest = v - four_of(s) * a;
  const float h = std::sqrt(sum_of(rest * rest));
  const FourFloats b = rest * four_of(1 / h);
  const float scale = 1 / std::sqrt((l + h) * (l + h) + s * s);
  const FourFloats cosine = four_of((l + h) * scale), sine = four_of(s * scale);
  const auto largest = [](FourFloats low, FourFloats high, FourFloats from) { return larger(high - from, from - low); };
  const FourFloats of_u = largest(hull.low.u, hull.high.u, cosine * a - sine * b);
  const FourFloats of_v = largest(hull.low.v, hull.high.v, sine * a + cosine * b);
  return (1 + hull.low.u[3] - sum_of(of_u * of_u + of_v * of_v)) / 2;
}

}  // namespace pliant
