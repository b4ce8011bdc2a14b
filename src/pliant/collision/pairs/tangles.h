#pragma once
// Where surfaces pass through each other, and which pairs are let go for that. All crossings are looked for once, where
// a simulation begins or surfaces change. From then on the exact checker is asked only for what lies around pairs that
// were let go, and around pinned vertices if some have moved: nothing else can have begun to cross, since planes keep
// it apart. Vertices are those of the solver, but in what State and reports have.
#include <algorithm>
#include <set>

#include "pliant/collision/contact/contact.h"
#include "pliant/collision/pairs/let_go.h"

namespace pliant {

class Tangles {
 public:
  /// The surface must stay.
  void set_surface(const Surface& surface) { surface_ = &surface; }
  void clear();

  /// A substep begins. Looks for all crossings there unless they are known.
  void begin(const ContactStep& step, const LetGoState& state);
  /// Whether they were.
  bool was_known() const { return was_known_; }
  const LetGo& let_go() const { return let_go_; }
  /// Lets go what crosses at q, too. Returns whether anything is new.
  bool follow(const Positions& q);

  /// Vertices of surfaces that lie in one place.
  void let_go_too(std::span<const LetGo::Vertices> pairs);
  /// Pinned vertices that have been held up for long, each with one of what is in its way, are let go until they are
  /// where they should be.
  void let_go_of(std::span<const LetGo::Vertices> held_up);
  /// The substep has ended at q: what crosses there is let go from now on, and what was held up and is not where it
  /// should be. lags: of each vertex, how far it is from there [m].
  void commit(const Positions& q, std::span<const Real> lags);
  void write(LetGoState& state) const;

  /// After commit(): crossings, and pinned vertices that were let go.
  Index count() const;
  /// After commit() at q: those that cross there or where it was looked for first, or of which one was held up, and of
  /// which nothing was let go before the substep; in their order.
  std::vector<LetGoBodies> new_bodies(const Positions& q) const;

 private:
  /// Of an edge through a triangle.
  struct Passage {
    Edge edge;
    Triangle triangle;
    Vec3 point;
  };

  struct BodyPins {
    bool has_pinned = false, has_free = false;

    bool is_held() const { return has_pinned && !has_free; }
  };

  using BodiesKey = std::pair<std::array<Index, 2>, bool>;  // and whether one was held up

  Index number_of(Index vertex) const { return numbers_.empty() ? vertex : numbers_[at(vertex)]; }
  /// Of bodies that are held as a whole, what is where it should be: it crosses itself where it is told to.
  template <class Feature>
  bool goes_as_told(const Feature& vertices) const {
    return std::ranges::all_of(vertices, [&](Index v) {
      return bodies_[at(surface_->body[at(v)])].is_held() && (lags_.empty() || !(lags_[at(v)] > 0));
    });
  }
  void mark_let_go();
  void find_all(const Positions& q);
  void find_around(const std::vector<char>& is_center, const Positions& q);
  void find(const Positions& q, std::span<const Triangle> triangles, std::span<const Edge> edges);
  std::vector<LetGo::Vertices> crossing_vertices() const;
  LetGoBodies bodies_of(const Passage& passage) const;
  LetGoBodies bodies_of(const LetGo::Vertices& held_up, const Positions& q) const;

  const Surface* surface_ = nullptr;
  const Positions* begin_ = nullptr;
  std::span<const char> is_pinned_;
  std::span<const Index> numbers_;  // of vertices in the simulation; empty: the same
  std::vector<BodyPins> bodies_;
  std::span<const Real> lags_;  // while it commits
  bool was_known_ = false;
  std::set<BodiesKey> known_bodies_;  // of which something was let go before the substep
  LetGo let_go_;
  std::vector<LetGo::Vertices> held_up_;  // those of let_go_ that are pinned and were held up
  std::vector<Passage> first_crossings_;  // where the substep began, if they were not known
  std::vector<Passage> crossings_;        // found last
  std::vector<Triangle> triangles_;       // scratch, as are these
  std::vector<Edge> edges_;
  std::vector<char> is_center_, is_around_;
};

}  // namespace pliant
