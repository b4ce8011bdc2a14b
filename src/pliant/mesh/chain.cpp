#include "pliant/mesh/chain.h"

#include <algorithm>
#include <unordered_map>

#include "pliant/mesh/topology.h"

namespace pliant {
namespace {

/// The places in the list of the vertices that each is joined to.
using Joined = std::vector<std::vector<std::size_t>>;

Joined joined_places(std::span<const Index> vertices, std::span<const Edge> edges) {
  std::unordered_map<Index, std::size_t> places;
  for (std::size_t i = 0; i < vertices.size(); ++i) places.emplace(vertices[i], i);
  Joined joined(vertices.size());
  for (const auto& [a, b] : edges) {
    const auto place_a = places.find(a), place_b = places.find(b);
    if (place_a == places.end() || place_b == places.end()) continue;
    joined[place_a->second].push_back(place_b->second);
    joined[place_b->second].push_back(place_a->second);
  }
  return joined;
}

bool are_joined(const Joined& joined, std::size_t a, std::size_t b) {
  return std::ranges::find(joined[a], b) != joined[a].end();
}

std::optional<Chain> as_given(std::span<const Index> vertices, const Joined& joined) {
  for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
    if (!are_joined(joined, i, i + 1)) return std::nullopt;
  }
  const bool is_closed = vertices.size() > 2 && are_joined(joined, 0, vertices.size() - 1);
  return Chain{{vertices.begin(), vertices.end()}, is_closed};
}

/// From the first end, or without one from the first vertex.
std::optional<Chain> walk(std::span<const Index> vertices, const Joined& joined) {
  if (std::ranges::any_of(joined, [](const auto& each) { return each.empty() || each.size() > 2; })) return {};
  const auto end = std::ranges::find(joined, std::size_t{1}, &std::vector<std::size_t>::size);
  Chain chain{{}, end == joined.end()};
  const auto first = chain.is_closed ? 0 : static_cast<std::size_t>(end - joined.begin());
  std::size_t before = first, here = first;
  do {
    chain.vertices.push_back(vertices[here]);
    const std::vector<std::size_t>& next = joined[here];
    const bool turns_back = next.size() == 1 && here != first;
    if (turns_back) break;
    const std::size_t to = next[0] == before && here != first ? next[1] : next[0];
    before = here;
    here = to;
  } while (here != first);
  if (chain.vertices.size() != vertices.size()) return {};  // there is another piece
  return chain;
}

}  // namespace

std::optional<Chain> chain_of(const Mesh& mesh, std::span<const Index> vertices) {
  if (vertices.size() < 2) return {};
  for (const std::vector<Edge>& edges : {boundary_edges(mesh), unique_edges(mesh)}) {
    const Joined joined = joined_places(vertices, edges);
    if (auto chain = as_given(vertices, joined)) return chain;
    if (auto chain = walk(vertices, joined)) return chain;
  }
  return {};
}

std::vector<Real> lengths_along(const Chain& chain, const Positions& x) {
  std::vector<Real> lengths = {0};
  const std::size_t count = chain.vertices.size();
  for (std::size_t i = 1; i <= count; ++i) {
    const bool is_way_back = i == count;
    const Real step = (row(x, chain.vertices[i % count]) - row(x, chain.vertices[i - 1])).norm();
    lengths.push_back(lengths.back() + (is_way_back && !chain.is_closed ? 0 : step));
  }
  return lengths;
}

}  // namespace pliant
