#pragma once
// Every number, choice, vector and flag among the options of a simulation, to be listed, read and changed while it
// runs: of its settings, groups, forces, colliders and contacts. The list is made from what the types themselves list
// (`visit`), so that a new option is in it without a line here.
//
//     for (const Parameter& each : list_parameters(simulation)) ...
//     set_parameter(simulation, {skin, "min_stretch"}, {0.9, 0, 0});
#include <compare>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "pliant/simulation/simulation.h"

namespace pliant {

/// The settings of contact as the owner of parameters.
struct ContactOwner {
  friend auto operator<=>(const ContactOwner&, const ContactOwner&) = default;
};

/// Whose option a parameter is: the settings' (std::monostate), a group's, a force's, a collider's, contact's, or that
/// of a body's own contact.
using ParameterOwner = std::variant<std::monostate, GroupId, ForceId, ColliderId, ContactOwner, BodyId>;

/// Which parameter: of whom, and the name of the option as in scene files.
struct ParameterHandle {
  ParameterOwner owner{};
  std::string option{};  ///< "stiffness"

  friend bool operator==(const ParameterHandle&, const ParameterHandle&) = default;
  friend bool operator<(const ParameterHandle& a, const ParameterHandle& b) {
    return std::tie(a.owner, a.option) < std::tie(b.owner, b.option);
  }
};

enum class ParameterKind { real, integer, choice, vector, flag };

struct Parameter {
  ParameterHandle handle;
  std::string type;  ///< of the group, force or collider: "triangle_strain"; of contacts: "contact"; else ""
  std::string name;  ///< of the group, force, collider or body; of all contact: "contact"; else ""
  std::string unit;  ///< "": none
  std::string doc;   ///< what it does
  ParameterKind kind = ParameterKind::real;
  Vec3 value = Vec3::Zero();           ///< [unit]; the first number alone, unless it is a vector; of a flag 0 or 1
  Range range{};                       ///< of each number
  std::vector<std::string> choices{};  ///< of kind choice: the value is an index into it
};

/// The settings, then all groups, all forces, all colliders, contact, and, where anything is touched, the contact of
/// each body, each with its options in their order. A body without a friction of its own has that of contact there. An
/// option that is a list with a number for each constraint or vertex has no parameter, and so has one that is left to
/// the rest positions; of such stiffnesses the common factor has one. Of constraints made elsewhere the stiffness is
/// all that there is; hard pins have none.
std::vector<Parameter> list_parameters(const Simulation& simulation);
/// Those of one of them. Throws Error(input) when the simulation does not have it.
std::vector<Parameter> list_parameters(const Simulation& simulation, const ParameterOwner& owner);

/// One of that list. Throws Error(input) when there is no such parameter.
Parameter parameter(const Simulation& simulation, const ParameterHandle& handle);

/// Changes one from the next step on. A stiffness costs one numeric factorization; every other option of a group makes
/// its constraints anew, as Simulation::replace does, with all targets and origins where they are; options of forces
/// cost nothing. Throws Error(input), with the simulation as it was, when there is no such parameter, and on a value
/// out of its range, naming option and range.
void set_parameter(Simulation& simulation, const ParameterHandle& handle, const Vec3& value);

}  // namespace pliant
