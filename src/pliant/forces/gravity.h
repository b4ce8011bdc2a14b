#pragma once
#include "pliant/forces/force_options.h"

namespace pliant {

/// f = m g on every vertex (thesis Eq. 5.2): of one body, or of all there are and will be. Conservative, with the
/// potential −Σ m g·x.
struct Gravity {
  static constexpr ForceInfo info{"gravity", "m g", "thesis Eq. 5.2", ForceReach::bodies};

  /// g [m/s²], any finite vector; default: the Earth's, along −z.
  Vec3 acceleration{0, 0, -9.81};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"acceleration", "m/s²", "g"}, self.acceleration);
  }
};

/// Throws Error(input) when g is not finite.
std::unique_ptr<Force> build(const ForceScope& scope, const Gravity& options);

}  // namespace pliant
