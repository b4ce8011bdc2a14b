#pragma once
#include "pliant/core/options.h"

namespace pliant {

/// How bodies touch what they meet. May be changed between steps.
struct ContactSettings {
  /// r [m], ≥ 0: how far from a surface vertices come to rest; 0: of each body a quarter of its short edges.
  Real distance = 0;
  /// μ ≥ 0 of Coulomb's law, where a collider has none of its own.
  Real friction = 0.3;

  friend bool operator==(const ContactSettings&, const ContactSettings&) = default;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"distance", "m",
                     "how far from a surface vertices come to rest; 0: of each body a quarter of its short edges",
                     not_negative},
          self.distance);
    field(OptionInfo{"friction", "", "μ of Coulomb's law, where a collider has none of its own", not_negative},
          self.friction);
  }
};

}  // namespace pliant
