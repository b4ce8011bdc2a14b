#pragma once
// What a pinned body that moves and all that lies on it have in common: a figure that turns takes its shirt along.
//
// What is held apart by planes that stand still is held back where it goes along their normals, though nothing comes
// nearer to anything. But only that there is some way to the next iterate on which nothing crosses counts, not which.
// So where a pinned body moves, the first way of a substep begins not at qₙ but where a rigid motion has taken that
// body and the bodies near it: a rigid image of what does not cross does not cross. What is left of the ways is short.
//
// Bodies that are nearer to each other than twice r go together. The motion is the one nearest to the ways of the
// pinned vertices in the sum of lengths, so that the trunk of a figure counts and its limbs hardly do. Nothing is moved
// with a body whose pins rest, such as a floor, or near one; nor where boxes around the ways meet those of what stays.
#include "pliant/collision/pairs/pair_list.h"

namespace pliant {

/// x goes to `to` + turn (x − from).
struct RigidMove {
  Mat3 turn = Mat3::Identity();
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();

  Vec3 operator()(const Vec3& x) const { return to + turn * (x - from); }
  /// The move nearest to the ways of these vertices in Σ ‖·‖; of a line the one that turns least about it.
  static RigidMove fit(std::span<const Index> vertices, const Positions& begin, const Positions& end);
};

class CommonMotions {
 public:
  struct Input {
    const Positions& begin;           ///< qₙ, where no surfaces cross [m]
    const Positions& end;             ///< where pinned vertices should be, and the others would be [m]
    std::span<const Index> pinned;    ///< vertices of the surface
    std::span<const char> is_pinned;  ///< of each vertex
    std::span<const Real> radii;      ///< r of each vertex [m]
  };

  /// Must stay.
  void set_surface(const Surface& surface);
  /// Whether a pinned body goes far enough, and much as a rigid one, so that find() may find something.
  bool may_help(const Input& input);
  /// After that. near: all pairs that are nearer than twice r at qₙ. Takes `start`, which is qₙ, to where the first way
  /// is to begin. Returns whether it is elsewhere.
  bool find(const Input& input, std::span<const PairList::Near> near, Positions& start);

 private:
  struct Part {
    std::vector<Index> vertices, pinned;  // vertices of the surface
    bool rests = false;                   // has pins of which at least half stay where they are
    bool leads = false;                   // others go with it
  };
  struct Cluster {
    std::vector<Index> parts;
    RigidMove move;
    bool goes = false;
  };
  struct SweptBox;

  void join(const Input& input, std::span<const PairList::Near> near);
  Index root_of(Index part);
  bool is_worth(const Input& input, const Cluster& cluster) const;
  bool drop_those_that_meet(const Input& input, const Positions& start);
  SweptBox box_of(const Input& input, const Positions& start, std::span<const Index> corners) const;

  const Surface* surface_ = nullptr;
  std::vector<Part> parts_;
  std::vector<Index> root_;        // of each part; itself where it is one
  std::vector<char> is_blocked_;   // of roots
  std::vector<Cluster> clusters_;  // with a leader, by their first part
  std::vector<Index> cluster_of_;  // of each part, −1 for what stays
};

}  // namespace pliant
