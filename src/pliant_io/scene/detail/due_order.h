#pragma once
#include <map>
#include <vector>

#include "pliant/timeline/timeline.h"
#include "pliant_io/scene/detail/json_node.h"

namespace pliant {

/// Events in the order in which they act, for a simulation that takes no steps: as if its clock ran.
class DueOrder {
 public:
  /// An event of the scene, with its "step" or "time".
  void add(const Node& node);
  const When& when(std::size_t event) const { return whens_[event]; }

  /// The events before the next step that has any, in the order of their adding; none when all have come. `time_step`
  /// is that of the simulation until then.
  std::vector<Index> next(Real time_step);

 private:
  static When read_when(const Node& node);
  bool is_due(Real time, Real time_step) const;
  template <class Waiting>
  static void take(Waiting& waiting, std::vector<Index>& due) {
    due.push_back(waiting.begin()->second);
    waiting.erase(waiting.begin());
  }

  std::vector<When> whens_;
  std::multimap<std::int64_t, Index> by_step_;
  std::multimap<Real, Index> by_time_;
  Real step_ = 0;
  Real time_ = 0;  // [s]
};

}  // namespace pliant
