#pragma once
// Which points of two chains of vertices a seam draws together.
#include "pliant/mesh/chain.h"

namespace pliant {

/// Which way along the second chain a seam goes: the one that brings its points nearer, or the other one.
enum class SeamDirection { nearest, opposite };
constexpr std::array<std::string_view, 2> choice_names(SeamDirection) {
  return {"nearest", "opposite"};
}

/// A vertex of one side, and the point (1 − share) a + share b between two consecutive vertices of the other.
struct Stitch {
  Index vertex = -1;
  Index a = -1;
  Index b = -1;     ///< a where share is 0
  Real share = 0;   ///< from 0 to below 1
  Real length = 0;  ///< of the seam that it stands for [m]: half of what lies on each side of it
};

/// Vertex by vertex, for chains of as many vertices, both closed or both open. Two ends can meet in two ways, two loops
/// in any turn: taken is what has the least sum of squared distances. x: of both chains [m].
std::vector<Stitch> stitch_in_order(const Chain& from, const Positions& x_from, const Chain& to, const Positions& x_to,
                                    SeamDirection direction);

/// By the share of the length: each vertex of `from` meets the point that is as far along `to`, where each length is
/// counted as 1. For chains of any number of vertices, both closed or both open.
std::vector<Stitch> stitch_by_length(const Chain& from, const Positions& x_from, const Chain& to, const Positions& x_to,
                                     SeamDirection direction);

}  // namespace pliant
