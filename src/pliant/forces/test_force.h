#pragma once
#include "pliant/forces/force_options.h"

namespace pliant {

/// A constant force on vertices for some frames; thesis Sec. 6.2.
struct TestForce {
  static constexpr ForceInfo info{"test_force", "F", "thesis Sec. 6.2", ForceReach::body, "force"};
  static constexpr std::int64_t forever = std::int64_t{1} << 53;

  /// Vertices of the body that it acts on; default: all.
  Selection vertices{};
  /// F [N], finite: one for all of these vertices, or one for each.
  Points force{};
  /// [a, b): it acts in the steps a ≤ n < b, 0 ≤ a < b. Substeps do not count.
  std::array<std::int64_t, 2> frames = {0, forever};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"vertices", "", "it acts on; or \"vertex\", an index"}, self.vertices);
    field(OptionInfo{"force", "N", "one for all vertices, or one for each"}, self.force);
    field(OptionInfo{"frames", "", "[a, b]: it acts in the steps a ≤ n < b; default: always"}, self.frames);
  }

  bool is_active(std::int64_t step) const { return frames[0] <= step && step < frames[1]; }
};

/// Throws Error(input) on a force that is not finite, a wrong number of forces, or an empty range.
std::unique_ptr<Force> build(const ForceScope& scope, const TestForce& options);

}  // namespace pliant
