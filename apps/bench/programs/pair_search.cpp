// How long it takes to find the pairs that may touch in a sheet folded like an accordion, its layers about an edge
// apart: the first time, when trees are built, and later, when they are refitted. Medians and least times of repeats,
// by one thread and by two in turns.
//
//     bench_pair_search [vertices a side [repeats [pad in edges]]]
#include "pliant/collision/pairs/pair_search.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "pliant/core/error.h"

namespace {

using namespace pliant;

Positions accordion(Index side) {
  const Real edge = 1 / static_cast<Real>(side - 1);
  const Real period = 0.1;
  Positions x(side * side, 3);
  for (Index j = 0; j < side; ++j) {
    for (Index i = 0; i < side; ++i) {
      const Real u = i * edge, v = j * edge;
      const Real place = std::fmod(u, period) / period;
      const Real fold = std::min(2 * place, 2 - 2 * place);
      x.row(j * side + i) << u * edge / 0.0572, v, fold * period / 2 + 0.3 * edge * std::sin(13 * v);
    }
  }
  return x;
}

std::vector<Triangle> triangles_of_grid(Index side) {
  std::vector<Triangle> triangles;
  for (Index j = 0; j + 1 < side; ++j) {
    for (Index i = 0; i + 1 < side; ++i) {
      const Index a = j * side + i, b = a + 1, c = a + side, d = c + 1;
      triangles.push_back({a, b, d});
      triangles.push_back({a, d, c});
    }
  }
  return triangles;
}

double milliseconds(const auto& act) {
  const auto begin = std::chrono::steady_clock::now();
  act();
  return 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> numbers) {
  std::ranges::sort(numbers);
  return numbers[numbers.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  const auto number = [&](int i, double otherwise) { return argc > i ? std::atof(argv[i]) : otherwise; };
  const auto side = static_cast<Index>(number(1, 224));
  const int repeats = static_cast<int>(number(2, 21));
  const Positions x = accordion(side);
  const std::vector<Triangle> triangles = triangles_of_grid(side);
  const SurfacePart part{.vertex_count = side * side, .triangles = triangles};
  const std::vector<Real> pads(at(side * side), number(3, 0.4) / 2 / static_cast<Real>(side - 1));
  try {
    const Surface surface(std::span(&part, 1), side * side, {});
    ThreadPool one(1), two(2);
    std::vector<double> builds, searches, searches_by_two;
    PairSearch search(surface);
    for (int i = 0; i < repeats; ++i) {
      PairSearch fresh(surface);
      builds.push_back(milliseconds([&] { fresh.find(x, x, pads, one); }));
    }
    search.find(x, x, pads, one);
    for (int i = 0; i < repeats; ++i) {
      searches.push_back(milliseconds([&] { search.find(x, x, pads, one); }));
      searches_by_two.push_back(milliseconds([&] { search.find(x, x, pads, two); }));
    }
    const auto count = [&](PairKind kind) { return std::ranges::count(search.pairs(), kind, &Pair::kind); };
    fmt::print("{} triangles: {} pairs of a vertex and a triangle, {} of edges\n", triangles.size(),
               count(PairKind::vertex_triangle), count(PairKind::edge_edge));
    fmt::print("first search {:.1f} ms\n", median(builds));
    fmt::print(
        "later ones: one thread {:.1f} ms, at least {:.1f}; two {:.1f} ms, at least {:.1f}: {:.2f} times as fast\n",
        median(searches), std::ranges::min(searches), median(searches_by_two), std::ranges::min(searches_by_two),
        median(searches) / median(searches_by_two));
    return 0;
  } catch (const Error& error) {
    fmt::print(stderr, "bench_pair_search: {}\n", error.what());
    return static_cast<int>(error.kind());
  }
}
