#pragma once
// What the panel has a slider, a menu or fields for: the parameters of a simulation, and which one each is after a
// restart, when groups and forces have other ids.
#include <functional>
#include <string>
#include <vector>

#include "pliant/simulation/parameters.h"

namespace pliant_viewer {

using pliant::Index;
using pliant::Real;

struct Slider {
  /// Which one it is, from restart to restart: "settings.iterations", "group:stretch.stiffness", and with a number
  /// behind the name where several have it. It is compared, never taken apart.
  std::string key;
  std::string heading;  ///< of its group, force, collider or body, for people: "triangle_strain \"stretch\""
  pliant::Parameter parameter;
  std::string body = {};  ///< whose group it is of; else empty
};

/// All parameters, but for groups that are hidden, in an order in which they can be set.
std::vector<Slider> list_sliders(const pliant::Simulation& simulation,
                                 const std::function<bool(pliant::GroupId)>& is_hidden = {});

}  // namespace pliant_viewer
