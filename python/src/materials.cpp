#include "materials.h"

#include "typed_options.h"

namespace pliant_python {
namespace {

const pliant::Material& named_material(const std::string& name) {
  if (const pliant::Material* found = pliant::find_builtin_material(name)) return *found;
  std::vector<std::string_view> names;
  for (const pliant::Material& each : pliant::builtin_materials()) names.push_back(each.name);
  pliant::fail_input("unknown material '" + name + "'; " + pliant::suggestion_text(name, names));
}

template <class Options>
void add_names(std::vector<std::string_view>& names) {
  const Options options;
  Options::visit(options, [&](const pliant::OptionInfo& info, const auto&) { names.push_back(info.name); });
}

}  // namespace

PlacedMaterial read_material(py::handle given) {
  if (py::isinstance<py::str>(given)) return {named_material(given.cast<std::string>()), {}};
  if (!py::isinstance<py::dict>(given) || !py::reinterpret_borrow<py::dict>(given).contains("name")) {
    pliant::fail_input("material: give the name of a material, or a dictionary with its \"name\"");
  }
  const auto numbers = py::reinterpret_borrow<py::dict>(given);
  PlacedMaterial made{named_material(py::object(numbers["name"]).cast<std::string>()), {}};
  std::vector<std::string_view> names = {"name"};
  add_names<pliant::SurfaceMaterial>(names);
  add_names<pliant::MaterialPlacement>(names);
  const OptionReader reader{numbers, "material", nullptr};
  const auto read_numbers = [&]<class Properties>(Properties& properties) {
    add_names<Properties>(names);
    check_keywords("material", numbers, names);
    Properties::visit(properties, reader);
    pliant::check_options("material", properties);
  };
  std::visit(read_numbers, made.material.of);
  pliant::SurfaceMaterial::visit(made.material.surface, reader);
  pliant::MaterialPlacement::visit(made.placement, reader);
  return made;
}

}  // namespace pliant_python
