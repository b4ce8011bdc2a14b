#pragma once
// The point of a surface that is nearest to a place.
#include <array>
#include <span>
#include <vector>

#include "pliant/mesh/mesh.h"

namespace pliant {

/// A point of a triangle.
struct FacePoint {
  Index triangle = -1;            ///< among those given; −1: there is none
  std::array<Real, 3> weights{};  ///< barycentric, from 0 to 1, summing to 1; exactly 0 on an edge or at a corner
  Real squared = 0;               ///< distance [m²]
};

/// The point of one triangle, which may be degenerate, nearest to a place.
FacePoint nearest_point(const Vec3& place, const std::array<Vec3, 3>& corners);

/// Finds points by a tree of boxes around triangles, each cut in halves across its longest side. Refers to x and to the
/// triangles, which must stay.
class NearestFace {
 public:
  NearestFace(const Positions& x, std::span<const Triangle> triangles);

  /// Of several at the same distance that of the first triangle.
  FacePoint operator()(const Vec3& place) const;

 private:
  static constexpr std::size_t largest_leaf = 4;

  struct Node {
    Eigen::AlignedBox<Real, 3> bounds{};
    std::size_t begin = 0;  // of its triangles in order_
    std::size_t end = 0;
    std::size_t second = 0;  // its halves are the node that follows and this one; 0: a leaf
  };

  std::array<Vec3, 3> corners(Index triangle) const;
  void build(std::span<const Vec3> centers, std::size_t begin, std::size_t end);
  void search(const Vec3& place, std::size_t node, FacePoint& best) const;

  const Positions& x_;
  std::span<const Triangle> triangles_;
  std::vector<Index> order_;
  std::vector<Node> nodes_;
};

}  // namespace pliant
