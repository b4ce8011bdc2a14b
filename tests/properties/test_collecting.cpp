// What a vertex gets from its constraints: the sums of all instruction sets, against sums one number after the other.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "../core/random.h"
#include "pliant/constraints/kernels/local_kernels.h"

namespace test_collecting {

using namespace pliant;
using namespace pliant_tests;

namespace {

enum class Coefficients { ones, signs, any };

/// A chunk of 300 vertices with 0 to 12 entries each, the last slot among them.
struct Chunk {
  static constexpr std::size_t slot_count = 500;

  explicit Chunk(Coefficients kind) {
    Random random;
    for (std::size_t i = 0; i < 3 * slot_count; ++i) slots.push_back(random.uniform(-1, 1));
    slots.push_back(std::numeric_limits<double>::quiet_NaN());  // read, but no part of any sum
    for (std::uint32_t vertex = 0; vertex < 300; ++vertex) {
      for (std::uint32_t k = 0; k < vertex % 13; ++k) {
        const auto slot = static_cast<std::size_t>(random.uniform(0, slot_count));
        const bool is_less = kind == Coefficients::signs && random.uniform(-1, 1) < 0;
        entries.push_back(static_cast<std::uint16_t>(2 * std::min(slot, slot_count - 1) + is_less));
        coefficients.push_back(kind == Coefficients::any ? random.uniform(-3, 3) : is_less ? -1 : 1);
      }
      ends.push_back(static_cast<std::uint32_t>(entries.size()));
    }
    entries.push_back(2 * (slot_count - 1));
    coefficients.push_back(1);
    ends.push_back(static_cast<std::uint32_t>(entries.size()));
  }

  std::vector<double> sums() const {
    std::vector<double> all(3 * ends.size());
    for (std::size_t vertex = 0, entry = 0; vertex < ends.size(); ++vertex) {
      for (; entry < ends[vertex]; ++entry) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          all[3 * vertex + axis] += coefficients[entry] * slots[3 * (entries[entry] / 2) + axis];
        }
      }
    }
    return all;
  }

  std::vector<double> slots, coefficients;
  std::vector<std::uint16_t> entries;
  std::vector<std::uint32_t> ends;
};

/// 200 vertices with up to three sums each; every seventh is pinned.
struct Gathering {
  static constexpr std::size_t count = 200;

  Gathering() {
    Random random;
    for (std::uint32_t i = 0; i < 2 * count; ++i) places.push_back((7 * i + 3) % (2 * count));
    for (std::size_t i = 0; i < 6 * count; ++i) sums.push_back(random.uniform(-1, 1));
    sums.push_back(std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < 3 * count; ++i) {
      q.push_back(random.uniform(-1, 1));
      s.push_back(random.uniform(-1, 1));
    }
    for (std::size_t i = 0, place = 0; i <= count; ++i) {
      offsets.push_back(place);
      place += i % 4;
      is_pinned.push_back(i % 7 == 0);
      weights.push_back(is_pinned.back() ? 0 : random.uniform(0.1, 2));
    }
  }

  /// All, or a part as a thread has it.
  GatheredSums run(const LocalKernels& kernels, std::vector<double>& r, std::size_t begin = 0,
                   std::size_t end = count) const {
    return kernels.gather({.sums = sums.data(),
                           .offsets = offsets.data(),
                           .places = places.data(),
                           .q = q.data(),
                           .s = s.data(),
                           .weights = weights.data(),
                           .is_pinned = is_pinned.data(),
                           .r = r.data(),
                           .begin = begin,
                           .end = end});
  }

  std::vector<double> sums, q, s, weights;
  std::vector<std::size_t> offsets;
  std::vector<std::uint32_t> places;
  std::vector<char> is_pinned;
};

TEST_CASE("all instruction sets collect the same bits") {
  for (const Coefficients kind : {Coefficients::ones, Coefficients::signs, Coefficients::any}) {
    CAPTURE(static_cast<int>(kind));
    const Chunk chunk(kind);
    for (const LocalKernels* kernels : local_kernels()) {
      CAPTURE(kernels->instruction_set);
      std::vector<double> sums(3 * chunk.ends.size() + 1, 17);
      const auto collect = kind == Coefficients::ones    ? kernels->collect_ones
                           : kind == Coefficients::signs ? kernels->collect_signs
                                                         : kernels->collect_any;
      collect({.slots = chunk.slots.data(),
               .entries = chunk.entries.data(),
               .coefficients = chunk.coefficients.data(),
               .ends = chunk.ends.data(),
               .count = chunk.ends.size(),
               .sums = sums.data()});
      CHECK(sums.back() == 17);  // another thread may be about to write it
      sums.pop_back();
      CHECK(sums == chunk.sums());
    }
  }
}

TEST_CASE("all instruction sets gather the same bits") {
  const Gathering vertices;
  std::vector<double> expected(3 * Gathering::count);
  double inertia = 0, squared_residual = 0;
  for (std::size_t i = 0; i < Gathering::count; ++i) {
    if (vertices.is_pinned[i]) continue;
    double way[3], force[3] = {};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t place = vertices.offsets[i]; place < vertices.offsets[i + 1]; ++place) {
        force[axis] += vertices.sums[3 * vertices.places[place] + axis];
      }
      way[axis] = vertices.s[3 * i + axis] - vertices.q[3 * i + axis];
      force[axis] += vertices.weights[i] * way[axis];
      expected[3 * i + axis] = force[axis];
    }
    inertia += vertices.weights[i] / 2 * (way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    squared_residual = std::max(squared_residual, force[0] * force[0] + force[1] * force[1] + force[2] * force[2]);
  }
  for (const LocalKernels* kernels : local_kernels()) {
    CAPTURE(kernels->instruction_set);
    std::vector<double> r(3 * Gathering::count + 1, 17);
    const GatheredSums found = vertices.run(*kernels, r);
    CHECK(found.inertia == inertia);
    CHECK(found.squared_residual == squared_residual);
    CHECK(r.back() == 17);
    r.pop_back();
    CHECK(r == expected);
  }
}

TEST_CASE("vertices are gathered part by part, and nothing beside a part is written") {
  const Gathering vertices;
  for (const LocalKernels* kernels : local_kernels()) {
    CAPTURE(kernels->instruction_set);
    std::vector<double> all(3 * Gathering::count);
    const GatheredSums whole = vertices.run(*kernels, all);
    double inertia = 0, squared_residual = 0;
    for (const auto& [begin, end] : {std::pair(0, 77), std::pair(77, 78), std::pair(78, 200)}) {
      const auto first = static_cast<std::size_t>(begin), last = static_cast<std::size_t>(end);
      std::vector<double> r(3 * Gathering::count, 17), expected = r;
      std::copy(all.begin() + 3 * begin, all.begin() + 3 * end, expected.begin() + 3 * begin);
      const GatheredSums part = vertices.run(*kernels, r, first, last);
      CHECK(r == expected);
      inertia += part.inertia;
      squared_residual = std::max(squared_residual, part.squared_residual);
    }
    CHECK(inertia == doctest::Approx(whole.inertia).epsilon(1e-14));
    CHECK(squared_residual == whole.squared_residual);
  }
}

TEST_CASE("NaN at a pinned vertex is ignored") {
  Gathering vertices;
  const std::size_t pinned = 7;
  REQUIRE(vertices.is_pinned[pinned]);
  vertices.s[3 * pinned] = std::numeric_limits<double>::quiet_NaN();
  for (const LocalKernels* kernels : local_kernels()) {
    CAPTURE(kernels->instruction_set);
    std::vector<double> r(3 * Gathering::count, 17);
    const GatheredSums found = vertices.run(*kernels, r);
    CHECK(std::isfinite(found.inertia + found.squared_residual));
    for (std::size_t axis = 0; axis < 3; ++axis) CHECK(r[3 * pinned + axis] == 0);
  }
}

TEST_CASE("one NaN residual makes the largest one NaN") {
  Gathering vertices;
  const std::size_t spoiled = 3 * 9 + 1;
  vertices.s[spoiled] = std::numeric_limits<double>::quiet_NaN();
  for (const LocalKernels* kernels : local_kernels()) {
    CAPTURE(kernels->instruction_set);
    std::vector<double> r(3 * Gathering::count);
    const GatheredSums found = vertices.run(*kernels, r);
    CHECK(std::isnan(found.squared_residual));
    CHECK(std::isnan(found.inertia));
    for (std::size_t k = 0; k < r.size(); ++k) CHECK(std::isnan(r[k]) == (k == spoiled));
  }
}

}  // namespace
}  // namespace test_collecting
