#pragma once
// Every type of the library that lists its options, behind one interface: what the classes of the module are made of.
// A type that is added to a list of the library is here without a line of its own.
#include <map>

#include "convert.h"

namespace pliant_python {

class OptionType {
 public:
  virtual ~OptionType() = default;

  /// The name in C++, "EdgeSpring", and in scene files, "edge_spring" ("" where it has none).
  virtual std::string class_name() const = 0;
  virtual std::string scene_name() const = 0;
  /// "constraint", "force", "collider", "shape" or "settings".
  virtual std::string kind() const = 0;
  /// What it is, as its list of types says: a formula, say.
  virtual std::string summary() const = 0;
  /// Of each option a dictionary with name, unit, doc, type, default, choices and word.
  virtual py::list fields() const = 0;
  /// Refuses names that it does not have, and values out of their range or of another type.
  virtual void check(const py::dict& given) const = 0;

  // Of those that a simulation takes. They return the number of what was added.
  virtual pliant::Index add(pliant::Simulation&, std::optional<pliant::BodyId>, const py::dict&,
                            const std::string&) const;
  virtual void replace(pliant::Simulation&, pliant::Index, const py::dict&) const;
  /// What that group, force or collider was made of; None where it was made of another type.
  virtual py::object options(const pliant::Simulation&, pliant::Index) const;

  /// Of a shape.
  virtual pliant::Mesh mesh(const py::dict&) const;
};

/// All of them, by the name of their class.
const std::map<std::string, std::unique_ptr<OptionType>>& option_types();
/// One of them. Throws Error(input) when there is none of that name.
const OptionType& option_type(const std::string& class_name);

}  // namespace pliant_python
