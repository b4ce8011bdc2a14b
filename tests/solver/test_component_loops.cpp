// Loops over components: each vertex once, the same sums by any number of threads.
#include <atomic>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "pliant/solver/component_loops.h"

namespace test_component_loops {

using namespace pliant;

struct Sizes {
  Index count, vertices;
};

/// So many components of so many vertices each, every other one numbered backwards.
Components components_of(Index count, Index vertices) {
  Components components;
  for (Index i = 0; i < count; ++i) {
    for (Index k = 0; k < vertices; ++k)
      components.vertices.push_back(i * vertices + (i % 2 == 0 ? k : vertices - 1 - k));
    components.starts.push_back(components.vertices.size());
  }
  return components;
}

Real value_of(Index vertex) {
  return std::sin(static_cast<Real>(vertex)) * std::exp(std::cos(1.7 * static_cast<Real>(vertex)) * 10);
}

std::vector<Real> sums_of(const Components& components, int threads) {
  ThreadPool pool(threads);
  std::vector<Real> sums(components.count(), 0);
  for_each_component(components, pool, [&](std::size_t i, ThreadPool* inside) {
    sums[i] = sum_over<Real>(components.component(i), inside, [](Real& sum, Index v) { sum += value_of(v); });
  });
  return sums;
}

TEST_CASE("component loops: sums are those of all vertices, to the same bits by any number of threads") {
  for (const Sizes& sizes : {Sizes{1, 1}, Sizes{1, 4096}, Sizes{1, 300'000}, Sizes{3, 20'000}, Sizes{500, 100}}) {
    CAPTURE(sizes.count);
    const Components components = components_of(sizes.count, sizes.vertices);
    const std::vector<Real> one = sums_of(components, 1);
    for (std::size_t i = 0; i < components.count(); ++i) {
      long double exact = 0, size = 0;
      for (const Index v : components.component(i)) {
        exact += value_of(v);
        size += std::abs(value_of(v));
      }
      REQUIRE(std::abs(static_cast<Real>(exact) - one[i]) <= 1e-13 * static_cast<Real>(size));
    }
    for (const int threads : {2, 3, 8}) CHECK(sums_of(components, threads) == one);
  }
}

TEST_CASE("component loops: a component no larger than a share is summed in order") {
  const Components components = components_of(2, 4000);
  Real in_order = 0;
  for (const Index v : components.component(1)) in_order += value_of(v);
  CHECK(sums_of(components, 2)[1] == in_order);
}

TEST_CASE("component loops: every vertex is met once, and large components by all threads") {
  Components mixed = components_of(200, 50);  // and one large one among them
  for (Index v = 0; v < 30'000; ++v) mixed.vertices.push_back(10'000 + v);
  mixed.starts.push_back(mixed.vertices.size());
  for (Index v = 0; v < 77; ++v) mixed.vertices.push_back(40'000 + v);
  mixed.starts.push_back(mixed.vertices.size());
  for (const Components& components :
       {components_of(1, 50'000), components_of(7, 9'000), components_of(1000, 33), components_of(20'000, 1), mixed}) {
    CAPTURE(components.count());
    for (const int threads : {1, 2, 8}) {
      ThreadPool pool(threads);
      std::vector<std::atomic<int>> times(components.vertices.size());
      std::atomic<int> wrong = 0;
      for_each_component(components, pool, [&](std::size_t i, ThreadPool* inside) {
        wrong += components.component(i).size() >= 8192 && inside == nullptr;
        for_each_vertex(components.component(i), inside, [&](Index v) { ++times[at(v)]; });
      });
      for (const auto& each : times) REQUIRE(each == 1);
      CHECK(wrong == 0);
    }
  }
  ThreadPool pool(2);
  for_each_component(Components{}, pool, [](std::size_t, ThreadPool*) { FAIL("there is none"); });
}

}  // namespace test_component_loops
