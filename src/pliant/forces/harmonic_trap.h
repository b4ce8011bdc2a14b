#pragma once
#include "pliant/forces/force_options.h"

namespace pliant {

/// f = m ω² (c − x) on every vertex: all of them swing about c with the same period 2π/ω. Conservative, with the
/// potential Σ m ω²/2 ‖x − c‖².
struct HarmonicTrap {
  static constexpr ForceInfo info{"harmonic_trap", "m ω² (c − x)", "", ForceReach::bodies};

  Vec3 center{0, 0, 0};  ///< c [m]
  Real frequency = 1;    ///< ω [1/s], > 0

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"center", "m", "c"}, self.center);
    field(OptionInfo{"frequency", "1/s", "ω", positive}, self.frequency);
  }
};

/// Throws Error(input) when a value is out of its range.
std::unique_ptr<Force> build(const ForceScope& scope, const HarmonicTrap& options);

}  // namespace pliant
