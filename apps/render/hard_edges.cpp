#include "render/hard_edges.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "pliant/mesh/geometry.h"

namespace pliant_render {
namespace {

using pliant::Index;

constexpr pliant::Real least_cosine = 0.643;  // of 50 degrees

/// Corners that belong together, by the root of each.
class Parts {
 public:
  explicit Parts(std::size_t count) : roots_(count) { std::iota(roots_.begin(), roots_.end(), std::size_t{0}); }
  std::size_t root(std::size_t i) {
    while (roots_[i] != i) i = roots_[i] = roots_[roots_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    const auto [low, high] = std::minmax({root(a), root(b)});
    roots_[high] = low;
  }

 private:
  std::vector<std::size_t> roots_;
};

}  // namespace

ShadedCorners split_at_hard_edges(const pliant::Positions& rest, const std::vector<pliant::Triangle>& triangles) {
  const pliant::Positions normals = pliant::triangle_normals(rest, triangles);
  // Each corner with the two edges that it has: vertex, other end, number of the corner.
  std::vector<std::tuple<Index, Index, std::size_t>> ends;
  ends.reserve(6 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (const std::size_t other : {(k + 1) % 3, (k + 2) % 3}) {
        ends.emplace_back(triangles[t][k], triangles[t][other], 3 * t + k);
      }
    }
  }
  std::ranges::sort(ends);
  Parts parts(3 * triangles.size());
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const auto& [vertex, other, corner] = ends[i];
    const auto& [vertex_before, other_before, corner_before] = ends[i - 1];
    if (vertex != vertex_before || other != other_before) continue;
    const auto a = static_cast<Eigen::Index>(corner / 3), b = static_cast<Eigen::Index>(corner_before / 3);
    if (normals.row(a).dot(normals.row(b)) > least_cosine) parts.join(corner, corner_before);
  }
  ShadedCorners corners;
  std::vector<std::uint32_t>& numbers = corners.numbers;
  numbers.resize(3 * triangles.size());
  std::vector<std::uint8_t> is_taken(static_cast<std::size_t>(rest.rows()), 0);
  for (std::size_t corner = 0; corner < numbers.size(); ++corner) {
    const std::size_t root = parts.root(corner);  // at most this corner, which therefore has its number by now
    const auto vertex = static_cast<std::size_t>(triangles[corner / 3][corner % 3]);
    if (root != corner) {
      numbers[corner] = numbers[root];
    } else if (is_taken[vertex] == 0) {
      numbers[corner] = static_cast<std::uint32_t>(vertex);
      is_taken[vertex] = 1;
    } else {
      numbers[corner] = static_cast<std::uint32_t>(is_taken.size() + corners.copies.size());
      corners.copies.push_back(static_cast<std::uint32_t>(vertex));
    }
  }
  return corners;
}

}  // namespace pliant_render
