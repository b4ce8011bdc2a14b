#pragma once
// Pinned vertices that stay behind where they should be, since something is in their way.
#include <map>

#include "pliant/collision/contact/contact.h"

namespace pliant {

class HeldUpVertices {
 public:
  /// A substep begins.
  void begin(const ContactStep& step, const LetGoState& state);
  /// It has ended at q; pinned: vertices, which should be at `targets` [m].
  void commit(const ContactStep& step, std::span<const Index> pinned, const Positions& targets, const Positions& q);
  void write(const ContactStep& step, LetGoState& state) const;

  /// Of each vertex, how far it is from where it should be [m]; 0 where that is no more than rounding.
  std::span<const Real> lags() const { return lags_; }
  Real largest_lag() const { return largest_lag_; }
  /// Whether a vertex has been held up for long.
  bool is_stuck(Index vertex) const;
  bool is_any_stuck() const;

 private:
  std::map<Index, Index> substeps_;  // in a row, of those that do not get on
  std::vector<Real> lags_;
  Real largest_lag_ = 0;
};

}  // namespace pliant
