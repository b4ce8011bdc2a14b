#pragma once
// The body-centered cubic lattice: corners and centers of cubes of side a, and the tetrahedra between them.
//
//        p+ ------           Two cubes that share a face, with centers c and d, and an edge p+ p− of that
//       / \      /           face make a tetrahedron: twelve of a³/12 for each cube, all alike (edges a
//      /   \    /            twice and √3/2 a four times, dihedral angles 60° and 90°). Within half a cube,
//     c --- p− -- d          with the coordinates by size |x₁| ≥ |x₂| ≥ |x₃| from its center in units of a,
//                            x₁ leads to d, x₂ to the edge:
//                            b(d) = x₁ − x₂, b(p±) = x₂ ± x₃, b(c) = 1 − x₁ − x₂.
//
// Source: the lattice of Labelle & Shewchuk 2007 (isosurface stuffing), uncut.
#include <array>

#include "pliant/mesh/mesh.h"

namespace pliant {

/// Cubes, the outermost of which nothing of a surface touches. Corners are numbered after centers.
class LatticeGrid {
 public:
  /// A place in a tetrahedron.
  struct Point {
    std::int64_t tetrahedron = 0;
    std::array<std::int64_t, 4> corners{};
    std::array<Real, 4> weights{};
  };

  static constexpr std::int64_t tetrahedra_of_cube = 12;

  LatticeGrid(const Vec3& origin, Real side, const std::array<Index, 3>& counts)
      : origin_(origin), side_(side), counts_(counts) {}

  Real side() const { return side_; }
  const std::array<Index, 3>& counts() const { return counts_; }
  std::int64_t cube_count() const { return std::int64_t{counts_[0]} * counts_[1] * counts_[2]; }
  std::int64_t tetrahedron_count() const { return tetrahedra_of_cube * cube_count(); }
  std::int64_t vertex_count() const {
    return cube_count() + (std::int64_t{counts_[0]} + 1) * (counts_[1] + 1) * (counts_[2] + 1);
  }
  Real tetrahedron_volume() const { return side_ * side_ * side_ / tetrahedra_of_cube; }

  std::int64_t cube(const std::array<Index, 3>& i) const {
    return (std::int64_t{i[2]} * counts_[1] + i[1]) * counts_[0] + i[0];
  }
  std::int64_t corner(const std::array<Index, 3>& i) const {
    return cube_count() + (std::int64_t{i[2]} * (counts_[1] + 1) + i[1]) * (counts_[0] + 1) + i[0];
  }
  /// Coordinates in units of the side, from the origin.
  Vec3 inside(const Vec3& place) const { return (place - origin_) / side_; }
  /// Position [m] of a vertex.
  Vec3 position(std::int64_t vertex) const;
  std::array<Index, 3> cube_at(const Vec3& in_sides) const;

  /// Half of a tetrahedron, that within a cube: towards the neighbor along `axis` on the `positive` side, and there to
  /// the edge of the face along the next axis (`second` 0) or the one after (1) on its positive side.
  struct Half {
    int axis = 0;
    int second = 0;
    bool axis_up = false;
    bool second_up = false;
  };
  std::int64_t tetrahedron(const std::array<Index, 3>& cube, const Half& half) const;
  /// c, d, p+, p−, as the drawing has them.
  std::array<std::int64_t, 4> corners(std::array<Index, 3> cube, const Half& half) const;
  static Half half_of(int number);  ///< 0 to 23
  /// The place is in the cube, in units of the side from its center.
  Point locate(const std::array<Index, 3>& cube, const Vec3& from_center) const;
  /// Corners of a tetrahedron, positively oriented.
  std::array<std::int64_t, 4> oriented_corners(std::int64_t tetrahedron) const;

 private:
  Vec3 origin_;
  Real side_;
  std::array<Index, 3> counts_;
};

}  // namespace pliant
