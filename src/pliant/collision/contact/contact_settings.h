#pragma once
#include "pliant/core/options.h"

namespace pliant {

/// How bodies touch what they meet. May be changed between steps. As long as a simulation has been given none, bodies
/// meet colliders alone: it has these, with `surfaces` false.
struct ContactSettings {
  /// r [m], ≥ 0: how far from a surface vertices come to rest; 0: of each body a quarter of its short edges.
  Real distance = 0;
  /// μ ≥ 0 of Coulomb's law, where neither side has its own.
  Real friction = 0.3;
  /// Whether bodies touch each other and themselves. A step takes up to several times as long with it; false: they
  /// meet colliders alone.
  bool surfaces = true;

  friend bool operator==(const ContactSettings&, const ContactSettings&) = default;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"distance", "m",
                     "how far from a surface vertices come to rest; 0: of each body a quarter of its short edges",
                     not_negative},
          self.distance);
    field(OptionInfo{"friction", "", "μ of Coulomb's law, where neither side has its own", not_negative},
          self.friction);
    field(OptionInfo{"surfaces", "", "whether bodies touch each other and themselves, and nothing passes through them"},
          self.surfaces);
  }
};

}  // namespace pliant
