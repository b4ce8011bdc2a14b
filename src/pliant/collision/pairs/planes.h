#pragma once
// Keeps surfaces from passing through each other while the vertices go straight from q to y.
//
// A pair is safe where its corners cannot have come together by the length of their ways, or where a direction is found
// along which the sides are apart both at q and at y: heights along it change in proportion to the way, so then the
// sides are apart all the way. Any other pair gets a plane between its sides at q, which its corners may not pass from
// then on, whatever happens to the others: so each pair gets at most one, and it ends. Corners slide along their
// planes: a way is projected onto the half-spaces of its vertex in four sweeps, and what still goes too far is
// shortened as a whole. Both can only make a way shorter, so pairs that were too far apart for the first ways need no
// second look; others are looked at again when a corner was moved.
//
// Motion is that of corners against each other, so layers that move together are not held back; and of several planes
// the one is taken that is least in the way, so sliding and parting are free. Which planes: across the line of the
// closest points; along both edges, or the triangle; across the normals of the vertices of one side, and of the other;
// along the motion of the sides against each other. First come pairs between which the distance of the surfaces has a
// minimum: a vertex that falls on a flat sheet and runs ahead must be stopped by what lies below it, and then passes
// over the rest.
//
// Rounding. Let u = ε (M + w), with the largest coordinate M at q and the longest way w of the corners of a pair. The
// half-spaces of both sides are almost a tenth of the gap γ apart. Heights over a plane, their products with ways, and
// the sum of place and way are each right within about 10 u; so for γ > 1000 u, where that is 90 u, the sides are apart
// in exact arithmetic as well. Nearer pairs get no room: a corner goes away from the plane by more than it can be
// wrong, or stays where it is, to the last bit; and where no plane has a gap of 100 ε M, all corners stay. So a pair
// that is farther apart remains so by about 90 ε M at least. What is nearer than 16 ε M from the start has no sides
// that could be told apart: it is left out and counted.
//
// Sources: A. Chen et al., Offset Geometric Contact, 2025 (bounds of motion); division planes as of the solvers of
// the physics engine Newton, 2026, that truncate at a plane for every pair.
#include "pliant/collision/pairs/gap.h"
#include "pliant/collision/pairs/way_boxes.h"
#include "pliant/core/thread_pool.h"

namespace pliant {

/// What else a vertex may not pass: its way from q, times the normal, is at least −room.
struct HalfSpace {
  Index vertex = 0;
  Vec3 normal = Vec3::UnitZ();  ///< of length 1
  Real room = 0;                ///< [m]; what is below 0 counts as 0
};

struct PlanesInput {
  const Positions& begin;  ///< q, where no surfaces cross [m]
  const Surface& surface;
  std::span<const Pair> pairs;        ///< all that might meet on the ways to y
  std::span<const Real> distances{};  ///< of each pair, or less than that, at q [m]; empty: not known
  std::span<const Real> radii;        ///< r of each vertex [m]
  std::span<const HalfSpace> half_spaces{};
  const WayBoxes* within = nullptr;  ///< which no way leaves; null: none
};

/// What was done to the ways.
struct Shortened {
  Index vertices = 0;  ///< whose ways were changed
  Index planes = 0;    ///< that held something back
  Index touching = 0;  ///< pairs at a distance of 0, but for rounding; nothing keeps them apart
  int passes = 0;      ///< until no more planes were needed
};

class Planes {
 public:
  /// Changes y, finite, so that no pair meets on the straight ways from q. What need not be changed keeps its bits. The
  /// same for every number of threads. Allocates nothing once grown.
  Shortened shorten(const PlanesInput& input, Positions& y, ThreadPool& threads);
  /// Of each vertex, whether the last call changed its way.
  std::span<const char> is_shortened() const { return is_shortened_; }

 private:
  static constexpr Index vertices_of_chunk = 1024;
  static constexpr Index pairs_of_chunk = 512;

  /// A pair whose corners' ways are long enough to bring it together.
  struct Near {
    Index pair = 0;
    Real distance = 0;
    Vec3 normal = Vec3::Zero();  ///< of the gap at q
    bool is_measured = false;    ///< else distance is a lower bound, and there is no normal
    bool is_waiting = false;     ///< for the next pass
    bool is_done = false;        ///< has a plane that holds, or touches
  };
  /// Of a pair.
  struct Plane {
    Vec3 normal = Vec3::Zero();  ///< towards the first side; zero: the corners stay
    std::array<Real, 4> rooms{};
    std::uint8_t passed = 0;  ///< bit j: by corner j
    bool is_touching = false;
    bool is_waiting = false;  ///< for the next pass
  };
  /// Of a vertex. Room below 0: −room is the least way along the normal, and the vertex stays where that cannot be.
  struct Bound {
    Vec3 normal;
    Real room;
    Index next;
  };
  struct Candidate;

  void begin(const PlanesInput& input, const Positions& y, ThreadPool& threads);
  void find_near(ThreadPool& threads);
  bool is_near(Near& near) const;
  Real reach(const Pair& pair, const std::vector<Real>& lengths) const;
  bool is_endangered(Near& near) const;
  bool is_in_reach(Near& near) const;
  bool is_clear(const Near& near) const;
  void add_half_spaces();
  void find_endangered(ThreadPool& threads);
  void find_normals();
  Plane choose(const Pair& pair, int pass) const;
  Real longest_way(const Pair& pair) const;
  void look_at(const Pair& pair, Candidate& candidate) const;
  Plane make_plane(const Pair& pair, const Candidate& best, Real unit) const;
  void add_planes(ThreadPool& threads, Shortened& done);
  void add_bound(Index vertex, const Vec3& normal, Real room);
  void mark(Index vertex);
  void move_changed(Positions& y, ThreadPool& threads);
  Vec3 bounded_way(Index vertex) const;

  const PlanesInput* input_ = nullptr;
  Positions wishes_;           // from q to y as it was
  Positions moves_;            // from q to y as it is now
  std::vector<Real> ways_;     // lengths of the wishes
  std::vector<Real> slacks_;   // what rounding may add to them
  std::vector<Real> reaches_;  // both together
  std::vector<std::vector<Near>> near_chunks_;
  std::vector<Near> near_;
  std::vector<std::vector<Index>> endangered_chunks_;
  std::vector<Index> endangered_;  // places in near_
  std::vector<Plane> planes_;      // of endangered_
  Positions normals_;              // of vertices of near pairs: sums over triangles
  std::vector<char> has_normal_;
  std::vector<Bound> bounds_;
  std::vector<Index> first_bound_;  // of each vertex, −1 for none
  std::vector<char> is_changed_;    // in this pass
  std::vector<Index> changed_;
  std::vector<char> is_shortened_;
};

}  // namespace pliant
