#pragma once
#include <cmath>
#include <optional>
#include <vector>

#include "pliant/core/options.h"

namespace pliant {

enum class BodyId : Index;

/// How a body touches, where that differs from ContactSettings.
///
/// One rule holds for all pairs, of two bodies or of a body and a collider. The distance of two bodies is the mean of
/// both, that from a collider the body's own. Friction is that of the side that has its own, the geometric mean where
/// both have, and that of the contact settings where none has.
struct BodyContact {
  /// r [m], ≥ 0: how far from a surface its vertices come to rest; 0: that of the contact settings.
  Real distance = 0;
  /// μ ≥ 0 of Coulomb's law; none: that of the other side, or of the contact settings.
  std::optional<Real> friction{};
  /// Whether it touches itself, where surfaces touch.
  bool self = true;
  /// Bodies that it does not touch; it is enough that one of two names the other.
  std::vector<BodyId> ignores{};

  friend bool operator==(const BodyContact&, const BodyContact&) = default;

  /// All but `ignores`, which scene files give by name.
  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"distance", "m", "how far from a surface its vertices come to rest; 0: that of `contact`",
                     not_negative},
          self.distance);
    field(OptionInfo{"friction", "", "μ of Coulomb's law; default: that of the other side, or of `contact`",
                     not_negative},
          self.friction);
    field(OptionInfo{"self", "", "whether it touches itself"}, self.self);
  }
};

/// μ of two sides, of which either may have its own.
inline Real friction_between(const std::optional<Real>& a, const std::optional<Real>& b, Real otherwise) {
  if (!a || !b || *a == *b) return a ? *a : b.value_or(otherwise);
  return std::sqrt(*a) * std::sqrt(*b);
}

/// μ of the surfaces of bodies.
struct SurfaceFrictions {
  std::vector<std::optional<Real>> own;  ///< of each part
  Real otherwise = 0;

  Real between(Index part_a, Index part_b) const {
    return friction_between(own[static_cast<std::size_t>(part_a)], own[static_cast<std::size_t>(part_b)], otherwise);
  }
};

}  // namespace pliant
