#include "option_types.h"

#include "added_types.h"
#include "pliant/collision/colliders/builtin.h"
#include "pliant/constraints/builtin.h"
#include "pliant/forces/builtin.h"
#include "pliant/mesh/lattice.h"
#include "pliant_io/mesh/mesh_file.h"

namespace pliant_python {

pliant::Index OptionType::add(pliant::Simulation&, std::optional<pliant::BodyId>, const py::dict&,
                              const std::string&) const {
  pliant::fail_input(class_name() + ": this is nothing that a simulation takes");
}

void OptionType::replace(pliant::Simulation&, pliant::Index, const py::dict&) const {
  pliant::fail_input(class_name() + ": this is nothing that a simulation takes");
}

py::object OptionType::options(const pliant::Simulation&, pliant::Index) const {
  return py::none();
}

pliant::Mesh OptionType::mesh(const py::dict&) const {
  pliant::fail_input(class_name() + ": this is no shape");
}

namespace {

using Types = std::map<std::string, std::unique_ptr<OptionType>>;

template <template <class> class Made, class... Options>
void add_types(Types& types, std::tuple<Options...>*) {
  const auto add = [&types](std::string name, std::unique_ptr<OptionType> type) {
    if (!types.emplace(name, std::move(type)).second) throw std::logic_error("two types are called " + name);
  };
  (add(class_name_of<Options>(), std::make_unique<Made<Options>>()), ...);
}

template <template <class> class Made, class List>
void add_types(Types& types) {
  add_types<Made>(types, static_cast<List*>(nullptr));
}

using Settings = std::tuple<pliant::SolverSettings, pliant::ContactSettings, pliant::BodyContact, pliant::ImportOptions,
                            pliant::MaterialPlacement, pliant::SheetMaterial, pliant::SolidMaterial,
                            pliant::SurfaceMaterial, pliant::LatticeOptions>;

Types make_types() {
  Types types;
  add_types<AddedType, pliant::BuiltinConstraints>(types);
  add_types<AddedType, std::tuple<pliant::Attachment>>(types);
  add_types<AddedType, pliant::BuiltinForces>(types);
  add_types<AddedType, pliant::BuiltinColliders>(types);
  add_types<ShapeType, pliant::Shapes>(types);
  add_types<TypedOptions, Settings>(types);
  return types;
}

}  // namespace

const Types& option_types() {
  static const Types types = make_types();
  return types;
}

const OptionType& option_type(const std::string& class_name) {
  const auto found = option_types().find(class_name);
  if (found == option_types().end()) pliant::fail_input("unknown type '" + class_name + "'");
  return *found->second;
}

}  // namespace pliant_python
