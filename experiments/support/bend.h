#pragma once
// One of the three ways in which a closed body resists bending.
#include <array>

#include "pliant/constraints/bending.h"
#include "pliant_io/scene/scene.h"

namespace pliant_experiments {

enum class Bend { none, absolute, signed_ };
constexpr std::array<Bend, 3> bends = {Bend::none, Bend::absolute, Bend::signed_};

constexpr const char* name_of(Bend bend) {
  constexpr std::array<const char*, 3> names = {"without bending", "absolute bending", "signed bending"};
  return names[static_cast<std::size_t>(bend)];
}

/// Adds it to the scene's first body as the group "bend"; stiffness [N m].
inline void add_bending(pliant::Scene& scene, Bend bend, double stiffness) {
  if (bend == Bend::none) return;
  const auto orientation = bend == Bend::absolute ? pliant::Orientation::absolute : pliant::Orientation::signed_;
  scene.simulation.add(pliant::BodyId{0}, pliant::Bending{.stiffness = stiffness, .orientation = orientation}, "bend");
}

}  // namespace pliant_experiments
