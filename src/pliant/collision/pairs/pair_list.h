#pragma once
// Which pairs may touch in a substep: those that are near at an iterate, and those that may meet on the way to the
// next. Moves from iterate to iterate are short, so a list of near pairs lasts for several, and tells of short ways
// too.
#include <optional>

#include "pliant/collision/pairs/flat_sheets.h"
#include "pliant/collision/pairs/gap.h"
#include "pliant/collision/pairs/let_go.h"
#include "pliant/collision/pairs/local_motion.h"
#include "pliant/collision/pairs/pair_search.h"
#include "pliant/collision/pairs/reduced_distances.h"
#include "pliant/collision/pairs/way_boxes.h"

namespace pliant {

class PairList {
 public:
  struct Near {
    Pair pair;
    Real radius = 0;    ///< r, or less where the surfaces are nearer at rest or were nearer at the start [m]
    Real distance = 0;  ///< where it was listed [m]
  };

  /// Surfaces at rest (m × 3) [m], and r of each vertex [m]. The surface must stay.
  void set_surface(const Surface& surface, const Positions& rest, std::span<const Real> radii);
  void clear();
  /// A substep begins. What is let go is not listed. Both must stay; changed_exceptions() is to be told of changes.
  void begin(std::span<const char> is_pinned, const LetGo& let_go, const ReducedDistances& reduced);
  void changed_exceptions() { is_listed_ = is_of_before_ = false; }
  /// Near pairs are at q now, as far apart as they were.
  void take_along(const Positions& q);
  /// At the next update, whatever is listed.
  void list_anew() { is_listed_ = false; }
  /// The first way is asked for by a search.
  void forget_before() { is_of_before_ = false; }

  /// Lists what is near at q anew if what is listed may not be all. Returns whether it has. Throws Error(input) where
  /// too many pairs are near each other.
  bool update(const Positions& q, ThreadPool& threads);
  /// Nearer than twice r, in the order of pairs, where they were listed.
  std::span<const Near> near() const { return near_; }
  /// Of these pairs, where they were listed.
  std::span<const Gap> gaps() const { return gaps_; }
  /// Of the pairs that `among` has those that are nearer than r at q, whether they are let go or not; with their whole
  /// r.
  std::vector<Near> nearer_than_radius(const Positions& q, const LetGo& among, ThreadPool& threads);
  /// What bound() is about.
  void go_to(const Positions& q);
  /// A near pair is no nearer than that [m].
  Real bound(const Near& near) const;

  /// Pairs that may meet on straight ways, and their distances or less where these begin [m].
  struct OnTheWay {
    std::vector<Pair> pairs;
    std::vector<Real> distances;
    bool is_all = true;  ///< else there are too many, and none is here
  };
  /// Vertices are to go from here to there. What is common to all ways brings nothing together.
  void begin_way(const Positions& from, const Positions& to);
  /// Those that may meet on it.
  const OnTheWay& on_the_way(const Positions& from, const Positions& to, ThreadPool& threads);
  const OnTheWay& last_on_the_way() const { return on_the_way_; }
  /// Whether these are all if some of the vertices are held back, and the way ends at q, no farther from where it
  /// began; the next search is for that, too.
  bool covers(const Positions& from, const Positions& to, const Positions& q);
  /// Where it is searched; null where all that may meet on a short way are known.
  const WayBoxes* boxes() const { return is_short_ || is_relative_ ? nullptr : &boxes_; }

 private:
  struct OwnRadius {
    Pair pair;
    Real radius;
  };
  struct Listed {
    Near near;
    Gap gap;
  };

  static bool is_same(const Positions& a, const Positions& b);
  void find_own_radii(const Positions& rest);
  void find_sheets(const Positions& rest);
  /// Of vertices that go from a to b: how far each goes, apart from `common`. Returns the farthest.
  Real find_lengths(const Positions& a, const Positions& b, const Vec3& common, std::vector<Real>& lengths) const;
  /// Of those, what is common to all ways, so that the longest of the rest is short.
  Vec3 common_way(const Positions& a, const Positions& b) const;
  void take_way(const Positions& from, const Positions& to, bool is_relative);
  void set_boxes(const Positions& from, const Positions& to);
  void collect_near_on_the_way(const Positions& from, const Positions& to, ThreadPool& threads);
  template <class Add>
  void collect_on_the_way(std::size_t count, ThreadPool& threads, Add&& add);
  bool lasts();
  bool is_short_way();
  const LocalMotion::Kept& kept_now();
  void list(const Positions& q, ThreadPool& threads);
  void take_own_radii();
  void reduce_radii();
  void add_on_the_way(const Pair& pair, Real bound, OnTheWay& found) const;
  Real radius_of(const Pair& pair) const;

  static constexpr std::size_t pairs_of_chunk = 512;

  const Surface* surface_ = nullptr;
  const LetGo* let_go_ = nullptr;
  const ReducedDistances* reduced_ = nullptr;
  std::optional<PairSearch> search_;
  std::vector<Real> radii_, pads_;
  Real smallest_radius_ = 0, largest_radius_ = 0;
  FlatSheets sheets_;
  LocalMotion motion_;                // since the near pairs were listed
  std::vector<OwnRadius> own_radii_;  // of pairs that are nearer than r at rest, in the order of pairs

  Positions reference_;  // where the near pairs were listed
  bool is_listed_ = false;
  bool is_of_before_ = false;    // they are of the substep before
  bool has_listed_all_ = false;  // none was let go
  std::vector<char> is_held_;
  std::vector<Near> near_;
  std::vector<Gap> gaps_;
  Positions now_;  // what the next two are about, if anything
  bool has_now_ = false;
  std::optional<LocalMotion::Kept> kept_;  // there, if that is known
  std::vector<Real> gone_;                 // since then, apart from what all have gone [m]
  Real farthest_gone_ = 0;

  WayBoxes boxes_;              // around ways
  Vec3 common_ = Vec3::Zero();  // to all of them [m]
  std::vector<Real> ways_;      // lengths [m]
  Real longest_way_ = 0;
  Positions end_;  // what the next two are about, if anything
  bool has_end_ = false;
  std::vector<Real> gone_at_end_;  // as gone_ [m]
  Real farthest_at_end_ = 0;
  std::optional<LocalMotion::Kept> kept_at_end_;
  bool is_short_ = false;            // so that no pair can meet that is not near
  bool is_relative_ = false;         // lengths are apart from what all go
  bool has_been_held_back_ = false;  // in this substep
  std::vector<std::vector<Listed>> listed_chunks_;
  std::vector<OnTheWay> way_chunks_;
  OnTheWay on_the_way_;
};

/// Calls visit(chunk, begin, end) for chunks of `size` in [0, count).
template <class Visit>
void for_each_chunk_of(std::size_t count, std::size_t size, ThreadPool& threads, Visit&& visit) {
  threads.parallel_for(static_cast<Index>((count + size - 1) / size), [&](Index i) {
    const std::size_t begin = at(i) * size;
    visit(at(i), begin, std::min(count, begin + size));
  });
}

}  // namespace pliant
