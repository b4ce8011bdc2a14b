#pragma once
// Vectors of 3 m numbers that are remembered from move to move, and what is done with them in chunks: sums of chunks
// are added in their order, so that the bits are those of one thread. They are kept in single precision: they steer
// where the iteration goes, not what it ends in.
#include <algorithm>
#include <array>

#include "pliant/core/aligned.h"
#include "pliant/core/thread_pool.h"
#include "pliant/core/types.h"

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

/// aᵀ c, in eight sums side by side, which the processor adds at once.
template <class Number>
Real dot(const Number* a, const Real* c, std::size_t count) {
  constexpr std::size_t lanes = 8;
  std::array<Real, lanes> sums = {};
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) sums[lane] += static_cast<Real>(a[i + lane]) * c[i + lane];
  }
  for (std::size_t lane = 0; i < count; ++i, ++lane) sums[lane] += static_cast<Real>(a[i]) * c[i];
  Real sum = 0;
  for (const Real lane : sums) sum += lane;
  return sum;
}

/// c ← c + alpha a + beta b
template <class Number>
void add(Real alpha, const Number* a, Real beta, const Number* b, Real* c, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) c[i] += alpha * static_cast<Real>(a[i]) + beta * static_cast<Real>(b[i]);
}

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
