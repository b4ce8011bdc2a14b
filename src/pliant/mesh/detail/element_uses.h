#pragma once
// Every edge and every triangle of a mesh together with the elements that use it, in passes over shares of them: beside
// the mesh there are never more than a million records in memory, or an eighth of all, unless a few edges have them.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "pliant/mesh/mesh.h"

namespace pliant {

/// An edge as one element has it.
struct EdgeUse {
  static constexpr std::uint32_t no_triangle = std::numeric_limits<std::uint32_t>::max();

  Index low;
  Index high;
  std::uint32_t code;  ///< 2 · triangle, and 1 more where it runs from high to low; no_triangle of other elements

  bool is_triangle() const { return code != no_triangle; }
  Index triangle() const { return static_cast<Index>(code / 2); }
  bool is_reversed() const { return code % 2 == 1; }
  auto key() const { return std::tuple(low, high); }
  friend auto operator<=>(const EdgeUse&, const EdgeUse&) = default;
};

/// A triangle by its vertices in ascending order.
struct TriangleUse {
  Triangle sorted;
  Index triangle;

  auto key() const { return sorted; }
  friend auto operator<=>(const TriangleUse&, const TriangleUse&) = default;
};

/// The side of a triangle opposite one of its vertices.
struct SideUse {
  Index vertex;
  Edge side;

  auto key() const { return vertex; }
  friend auto operator<=>(const SideUse&, const SideUse&) = default;
};

/// Sorts records into groups of one key. `emit_all` calls its argument with every record and is run twice a pass;
/// `share` maps a record to any number below 2^32 that depends on its key alone; `visit` gets each group, ascending.
template <class Use, class EmitAll, class Share, class Visit>
void visit_groups(std::uint64_t count, const EmitAll& emit_all, const Share& share, const Visit& visit) {
  constexpr std::uint64_t at_once = 1 << 20;
  const std::uint64_t passes = count / std::max(at_once, count / 8) + 1;
  for (std::uint64_t pass = 0; pass < passes; ++pass) {
    const auto is_mine = [&](const Use& use) { return passes == 1 || (share(use) * passes) >> 32 == pass; };
    std::size_t mine = 0;
    emit_all([&](const Use& use) { mine += is_mine(use) ? 1 : 0; });
    std::vector<Use> uses;
    uses.reserve(mine);
    emit_all([&](const Use& use) {
      if (is_mine(use)) uses.push_back(use);
    });
    std::ranges::sort(uses);
    for (auto first = uses.begin(); first != uses.end();) {
      const auto last = std::find_if(first, uses.end(), [&](const Use& use) { return use.key() != first->key(); });
      visit(std::span<const Use>(&*first, static_cast<std::size_t>(last - first)));
      first = last;
    }
  }
}

inline std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
  return ((a * 0x9e3779b97f4a7c15u ^ b) * 0xbf58476d1ce4e5b9u) >> 32;
}

/// Calls emit(EdgeUse) for each edge of each element.
template <class Emit>
void emit_edge_uses(const Mesh& mesh, const Emit& emit) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index from = mesh.triangles[t][i];
      const Index to = mesh.triangles[t][(i + 1) % 3];
      emit(EdgeUse{std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(2 * t + (from < to ? 0 : 1))});
    }
  }
  const auto emit_other = [&](Index a, Index b) {
    emit(EdgeUse{std::min(a, b), std::max(a, b), EdgeUse::no_triangle});
  };
  for (const auto& [a, b] : mesh.edges) emit_other(a, b);
  for (const Tetrahedron& tetrahedron : mesh.tetrahedra) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) emit_other(tetrahedron[i], tetrahedron[j]);
    }
  }
}

/// Calls visit(span of EdgeUse) for each edge; those of triangles come first, ascending.
template <class Visit>
void visit_edges(const Mesh& mesh, const Visit& visit) {
  visit_groups<EdgeUse>(
      3 * mesh.triangles.size() + mesh.edges.size() + 6 * mesh.tetrahedra.size(),
      [&](const auto& emit) { emit_edge_uses(mesh, emit); },
      [](const EdgeUse& use) {
        return mixed(static_cast<std::uint64_t>(use.low), static_cast<std::uint64_t>(use.high));
      },
      visit);
}

/// Calls visit(span of SideUse) for each vertex that has triangles and is wanted.
template <class IsWanted, class Visit>
void visit_vertices(const Mesh& mesh, const IsWanted& is_wanted, const Visit& visit) {
  const auto emit_all = [&](const auto& emit) {
    for (const auto& [a, b, c] : mesh.triangles) {
      if (is_wanted(a)) emit(SideUse{a, {b, c}});
      if (is_wanted(b)) emit(SideUse{b, {c, a}});
      if (is_wanted(c)) emit(SideUse{c, {a, b}});
    }
  };
  const auto share = [](const SideUse& use) { return mixed(static_cast<std::uint64_t>(use.vertex), 0); };
  visit_groups<SideUse>(3 * mesh.triangles.size(), emit_all, share, visit);
}

/// Calls visit(span of TriangleUse) for each three vertices that have a triangle.
template <class Visit>
void visit_triangles(const Mesh& mesh, const Visit& visit) {
  const auto emit_all = [&](const auto& emit) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      TriangleUse use{mesh.triangles[t], static_cast<Index>(t)};
      std::ranges::sort(use.sorted);
      emit(use);
    }
  };
  const auto share = [](const TriangleUse& use) {
    const auto& [a, b, c] = use.sorted;
    return mixed(mixed(static_cast<std::uint64_t>(a), static_cast<std::uint64_t>(b)), static_cast<std::uint64_t>(c));
  };
  visit_groups<TriangleUse>(mesh.triangles.size(), emit_all, share, visit);
}

}  // namespace pliant
