#pragma once
// Loops over the vertices of components by all threads. Sums are those of shares of a component, added in order: how
// large the shares are depends on the component alone, so the bits do not depend on the number of threads.
#include <algorithm>
#include <array>
#include <span>

#include "pliant/core/thread_pool.h"
#include "pliant/solver/global/components.h"

namespace pliant {

/// A sum of vectors and one of weights, whose quotient is a mean.
struct MeanSum {
  Vec3 vector = Vec3::Zero();
  Real weight = 0;

  Vec3 mean() const { return vector / weight; }
  MeanSum& operator+=(const MeanSum& other) {
    vector += other.vector;
    weight += other.weight;
    return *this;
  }
};

/// Into how many shares a loop over so many vertices is cut, 1 to most_shares.
struct VertexShares {
  static constexpr Index most_shares = 64;
  static constexpr Index least_vertices = 4096;

  explicit VertexShares(Index vertices)
      : vertex_count(vertices), count(std::clamp<Index>(vertices / least_vertices, 1, most_shares)) {}
  Index begin(Index share) const { return static_cast<Index>(std::int64_t{vertex_count} * share / count); }

  Index vertex_count, count;
};

/// Calls body(i) for i in [0, count). threads: none: the caller's alone.
template <class Body>
void for_each_vertex(Index count, ThreadPool* threads, Body&& body) {
  const VertexShares shares(count);
  const auto take = [&](Index share) {
    for (Index i = shares.begin(share); i < shares.begin(share + 1); ++i) body(i);
  };
  if (threads != nullptr) {
    threads->parallel_for(shares.count, take);
  } else {
    for (Index share = 0; share < shares.count; ++share) take(share);
  }
}

/// The same for vertices of a component: body(vertex).
template <class Body>
void for_each_vertex(std::span<const Index> vertices, ThreadPool* threads, Body&& body) {
  for_each_vertex(static_cast<Index>(vertices.size()), threads, [&](Index i) { body(vertices[at(i)]); });
}

/// Sums up: add(sum, vertex) for each of them. Sum begins as Sum{} and has +=.
template <class Sum, class Add>
Sum sum_over(std::span<const Index> vertices, ThreadPool* threads, Add&& add) {
  const VertexShares shares(static_cast<Index>(vertices.size()));
  const auto sum_of = [&](Index share) {
    Sum sum{};
    for (Index i = shares.begin(share); i < shares.begin(share + 1); ++i) add(sum, vertices[at(i)]);
    return sum;
  };
  if (shares.count == 1) return sum_of(0);
  std::array<Sum, VertexShares::most_shares> sums;
  const auto take = [&](Index share) { sums[at(share)] = sum_of(share); };
  if (threads != nullptr) {
    threads->parallel_for(shares.count, take);
  } else {
    for (Index share = 0; share < shares.count; ++share) take(share);
  }
  for (Index share = 1; share < shares.count; ++share) sums[0] += sums[at(share)];
  return sums[0];
}

/// Calls body(component, threads), with the threads for the loops inside: large components one after the other by all
/// threads, the others side by side where they are many vertices.
template <class Body>
void for_each_component(const Components& components, ThreadPool& threads, Body&& body) {
  const auto count = static_cast<Index>(components.count());
  const VertexShares shares(static_cast<Index>(components.vertices.size()));
  if (shares.count == 1 || count == 1) {
    for (Index i = 0; i < count; ++i) body(at(i), &threads);
    return;
  }
  const auto is_large = [&](Index i) {
    return VertexShares(static_cast<Index>(components.component(at(i)).size())).count > 1;
  };
  // Of each share the components that begin in it.
  const auto first_of = [&](Index share) {
    const auto place = static_cast<std::size_t>(shares.begin(share));
    return static_cast<Index>(std::ranges::lower_bound(components.starts, place) - components.starts.begin());
  };
  threads.parallel_for(shares.count, [&](Index share) {
    for (Index i = first_of(share), end = std::min(count, first_of(share + 1)); i < end; ++i) {
      if (!is_large(i)) body(at(i), static_cast<ThreadPool*>(nullptr));
    }
  });
  for (Index i = 0; i < count; ++i) {
    if (is_large(i)) body(at(i), &threads);
  }
}

}  // namespace pliant
