#pragma once
// Vectors of 3 m numbers that are remembered from move to move, and what is done with them in chunks: sums of chunks
// are added in their order, so that the bits are those of one thread. They are kept in single precision: they steer
// where the iteration goes, not what it ends in.
#include <algorithm>
#include <array>

#include "pliant/core/aligned.h"
#include "pliant/core/thread_pool.h"
#include "pliant/core/types.h"
#include "pliant/solver/acceleration/remembered_kernels.h"

namespace pliant::remembered {

using Kept = float;
using Vector = AlignedVector<Kept>;

constexpr Index vertices_at_once = 512;
constexpr Index chunk_count(Index vertex_count) {
  return (vertex_count + vertices_at_once - 1) / vertices_at_once;
}

/// Numbers of a chunk, in the cache.
using ChunkSum = std::array<Real, 3 * static_cast<std::size_t>(vertices_at_once)>;

/// The first of so many entries goes behind the others.
template <class List>
void drop_first(List& list, std::size_t count) {
  const auto begin = list.begin();
  std::rotate(begin, begin + 1, begin + static_cast<std::ptrdiff_t>(count));
}

/// aᵀ c
inline Real dot(const Real* a, const Real* c, std::size_t count) {
  return fastest_remembered_kernels().product(a, c, count);
}

/// Of one chunk: where some vectors begin there, with a factor of each.
template <std::size_t most>
struct ChunkOfVectors {
  std::array<const Kept*, most> vectors = {};
  std::array<Real, most> factors = {};
  std::size_t count = 0;

  void add(const Vector& vector, std::size_t first, Real factor = 0) {
    vectors[count] = vector.data() + first;
    factors[count++] = factor;
  }
  /// Products with c go to `sums`.
  void multiply(const Real* c, std::size_t numbers, Real* sums) const {
    fastest_remembered_kernels().products(vectors.data(), count, c, numbers, sums);
  }
  /// A move along all of them.
  void move(RememberedMove move, std::size_t numbers) {
    if (count % 2 == 1) vectors[count] = vectors[count - 1];  // its factor is 0
    move.vectors = vectors.data(), move.factors = factors.data(), move.pairs = (count + 1) / 2;
    fastest_remembered_kernels().move(move, numbers);
  }
};

/// Calls visit(chunk, first number, count of numbers).
template <class Visit>
void for_each_chunk(Index vertex_count, ThreadPool& threads, Visit&& visit) {
  threads.parallel_for(chunk_count(vertex_count), [&](Index i) {
    const Index begin = i * vertices_at_once;
    const Index end = std::min(vertex_count, begin + vertices_at_once);
    visit(at(i), 3 * at(begin), 3 * at(end - begin));
  });
}

}  // namespace pliant::remembered
