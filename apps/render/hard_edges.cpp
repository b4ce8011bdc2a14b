#include "render/hard_edges.h"

#include <algorithm>
#include <limits>
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

/// Numbers corners: those of one part with one texture coordinate have the same number.
class CornerNumbers {
 public:
  CornerNumbers(std::size_t vertex_count, std::size_t corner_count)
      : vertex_count_(static_cast<std::uint32_t>(vertex_count)),
        is_taken_(vertex_count, 0),
        first_of_part_(corner_count, none) {
    corners_.numbers.reserve(corner_count);
  }

  void add(std::uint32_t vertex, std::size_t part, Index texture) {
    std::uint32_t number = first_of_part_[part];
    while (number != none && texture_of(number) != texture) number = next_of(number);
    corners_.numbers.push_back(number != none ? number : take(vertex, part, texture));
  }
  ShadedCorners take_all() { return std::move(corners_); }

 private:
  static constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  struct Entry {
    Index texture;
    std::uint32_t next;
  };

  const Entry& entry(std::uint32_t number) const {
    return number < vertex_count_ ? of_vertices_.at(number) : of_copies_[number - vertex_count_];
  }
  Index texture_of(std::uint32_t number) const { return entry(number).texture; }
  std::uint32_t next_of(std::uint32_t number) const { return entry(number).next; }

  /// A new number in front of those of its part.
  std::uint32_t take(std::uint32_t vertex, std::size_t part, Index texture) {
    const std::uint32_t before = first_of_part_[part];
    const Entry entry{texture, before};
    std::uint32_t number = vertex;
    if (is_taken_[vertex] == 0) {
      is_taken_[vertex] = 1;
      if (of_vertices_.empty()) of_vertices_.resize(vertex_count_);
      of_vertices_[vertex] = entry;
    } else {
      number = vertex_count_ + static_cast<std::uint32_t>(corners_.copies.size());
      corners_.copies.push_back(vertex);
      corners_.normals_from.push_back(before == none ? number : normal_of(before));
      of_copies_.push_back(entry);
    }
    first_of_part_[part] = number;
    return number;
  }
  std::uint32_t normal_of(std::uint32_t number) const {
    return number < vertex_count_ ? number : corners_.normals_from[number - vertex_count_];
  }

  std::uint32_t vertex_count_;
  std::vector<std::uint8_t> is_taken_;
  std::vector<std::uint32_t> first_of_part_;
  std::vector<Entry> of_vertices_, of_copies_;
  ShadedCorners corners_;
};

/// Corners of triangles that meet smoothly are in one part.
Parts smooth_parts(const pliant::Positions& rest, const std::vector<pliant::Triangle>& triangles) {
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
  return parts;
}

}  // namespace

ShadedCorners split_at_hard_edges(const pliant::Positions& rest, const std::vector<pliant::Triangle>& triangles,
                                  const std::vector<Index>& texture) {
  Parts parts = smooth_parts(rest, triangles);
  CornerNumbers numbers(static_cast<std::size_t>(rest.rows()), 3 * triangles.size());
  for (std::size_t corner = 0; corner < 3 * triangles.size(); ++corner) {
    const auto vertex = static_cast<std::uint32_t>(triangles[corner / 3][corner % 3]);
    numbers.add(vertex, parts.root(corner), texture.empty() ? -1 : texture[corner]);
  }
  return numbers.take_all();
}

}  // namespace pliant_render
