#pragma once
// What contact between surfaces has let go, and what begins nearer than its distance: a part of State and of the report
// of a step.
#include <cstdint>
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// Two vertices. Pairs with the one on the one side and the other on the other side are let go: nothing keeps them
/// apart, and they do not push each other.
struct LetGoVertices {
  std::array<Index, 2> vertices{};  ///< the smaller first
  bool is_held_up = false;          ///< one of them is pinned and was held up for long; else surfaces cross there

  friend bool operator==(const LetGoVertices&, const LetGoVertices&) = default;
};

/// A vertex that is, or was, nearer to a body than its contact distance.
struct ReducedDistance {
  Index vertex = 0;
  Index body = 0;  ///< the other one, or its own
  Real share = 1;  ///< of the distance that it keeps from that body now, in (0, 1)

  friend bool operator==(const ReducedDistance&, const ReducedDistance&) = default;
};

/// A pinned vertex that does not get on to where it should be.
struct HeldUpVertex {
  Index vertex = 0;
  Index substeps = 0;  ///< in a row

  friend bool operator==(const HeldUpVertex&, const HeldUpVertex&) = default;
};

struct LetGoState {
  /// Whether crossings have been looked for since bodies were added, moved by hand or told to touch.
  bool is_known = false;
  std::vector<LetGoVertices> pairs;      ///< by their vertices
  std::vector<ReducedDistance> reduced;  ///< by vertex, then body
  std::vector<HeldUpVertex> held_up;     ///< by vertex

  bool is_empty() const { return !is_known && pairs.empty() && reduced.empty() && held_up.empty(); }
};

/// Two bodies of which pairs begin to be let go, or one with itself, and the first of these pairs.
struct LetGoBodies {
  std::array<Index, 2> bodies{};  ///< the smaller first
  bool is_held_up = false;        ///< a pinned one was held up for long; else they cross
  /// Vertices of the simulation: of the edge and the triangle that cross. Of what was held up the pinned vertex twice,
  /// and one of the other body three times.
  Edge edge{};
  Triangle triangle{};
  Vec3 place = Vec3::Zero();  ///< [m]
};

}  // namespace pliant
