#pragma once
// Everything about a simulation that has a slider: made from what the types themselves list, so that a new option has
// its slider without a line here.
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "pliant/simulation/simulation.h"

namespace pliant_viewer {

using pliant::Index;
using pliant::Real;

enum class ParameterKind { real, integer, choice, vector };

struct Parameter {
  /// Which one it is, from restart to restart: "settings", a group or a force by type, name and number.
  std::string section;  ///< "group:stretch:1"
  std::string heading;  ///< of its section, for people: "triangle_strain \"stretch\""
  std::string name;     ///< as in scene files: "stiffness"
  std::string unit;
  std::string doc;
  ParameterKind kind = ParameterKind::real;
  pliant::Vec3 value = pliant::Vec3::Zero();  ///< the first number alone, unless it is a vector
  pliant::Range range{};
  std::vector<std::string> choices{};  ///< of kind choice: the value is an index into it

  std::string key() const { return section + "." + name; }
};

/// The solver's settings, the stiffness of each group that has one, but for a hidden one, and the options of each force
/// that can be changed.
std::vector<Parameter> list_parameters(const pliant::Simulation& simulation,
                                       std::optional<pliant::GroupId> hidden = {});

/// Changes one by its key. Returns false where there is no such parameter.
/// @throws pliant::Error (input): a value out of its range
bool set_parameter(pliant::Simulation& simulation, std::string_view key, const pliant::Vec3& value);

}  // namespace pliant_viewer
