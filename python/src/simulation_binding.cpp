#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bindings.h"
#include "materials.h"
#include "option_types.h"
#include "own_types.h"
#include "pliant/simulation/carried_surface.h"
#include "pliant/simulation/transaction.h"
#include "pliant_io/checkpoint/state_file.h"
#include "typed_options.h"

namespace pliant_python {
namespace {

using pliant::BodyId;
using pliant::Index;
using pliant::Mass;

std::shared_ptr<Handle> make_simulation(const py::dict& given) {
  return std::make_shared<Handle>(
      std::make_shared<pliant::Simulation>(read_options<pliant::SolverSettings>(given, nullptr)));
}

/// Each kind that is given, all added up.
std::optional<Mass> read_mass(const py::dict& given) {
  check_keywords("mass", given, {"per_vertex", "total", "area_density", "density", "line_density", "each"});
  std::optional<Mass> sum;
  for (const auto& [key, value] : given) {
    const auto kind = key.cast<std::string>();
    const pliant::OptionInfo info{kind, "", ""};
    const Place place{"mass", info};
    std::optional<Mass> part;
    if (kind == "each") {
      pliant::Values values;
      read(place, value, values);
      part = Mass::each(values.list());
    } else {
      pliant::Real number = 0;
      read(place, value, number);
      if (kind == "per_vertex") part = Mass::per_vertex(number);
      if (kind == "total") part = Mass::total(number);
      if (kind == "area_density") part = Mass::area_density(number);
      if (kind == "density") part = Mass::density(number);
      if (kind == "line_density") part = Mass::line_density(number);
    }
    sum = sum ? *sum + *part : *part;
  }
  return sum;
}

struct BodyArguments {
  std::string name;
  py::object start, velocities, material;
};

Index add_body(Handle& handle, const pliant::Mesh& mesh, const py::dict& given_mass, const BodyArguments& arguments) {
  pliant::BodyOptions options{.name = arguments.name};
  if (!arguments.start.is_none()) options.start = read_rows(arguments.start, "add_body: start");
  if (!arguments.velocities.is_none()) {
    options.velocities = read_rows(arguments.velocities, "add_body: velocities");
  }
  std::optional<Mass> mass = read_mass(given_mass);
  std::optional<PlacedMaterial> material;
  if (!arguments.material.is_none()) material = read_material(arguments.material);
  if (!mass && material) mass = mass_of(material->material);
  if (!mass) {
    pliant::fail_input(
        "add_body: without a mass; give one of per_vertex, total, area_density, density, line_density or each, or a "
        "material");
  }
  handle.let_go_of_arrays();
  pliant::Simulation& simulation = handle.idle();
  if (material) {
    const std::string reason = misfit(material->material, mesh);
    if (!reason.empty()) pliant::fail_input("add_body: " + reason);
  }
  pliant::Transaction transaction(simulation);
  const BodyId id = simulation.add_body(mesh, *mass, std::move(options));
  if (material) pliant::add_material(simulation, id, material->material, material->placement);
  transaction.commit();
  return static_cast<Index>(id);
}

std::optional<BodyId> body_of(std::optional<Index> body) {
  return body ? std::optional(BodyId{*body}) : std::nullopt;
}

/// Vertices of the body as those of the simulation.
Indices indices_in(const pliant::Simulation& simulation, BodyId body, const Indices& stencils) {
  Indices result(std::vector<py::ssize_t>(stencils.shape(), stencils.shape() + stencils.ndim()));
  for (py::ssize_t i = 0; i < stencils.size(); ++i) {
    result.mutable_data()[i] = simulation.vertex(body, stencils.data()[i]);
  }
  return result;
}

void bind_state(py::class_<Handle, std::shared_ptr<Handle>>& simulation) {
  simulation
      .def("state_bytes",
           [](Handle& handle) {
             return py::bytes(handle.run([](pliant::Simulation& made) { return pliant::state_bytes(made); }));
           })
      .def("write_state",
           [](Handle& handle, const std::filesystem::path& path) {
             handle.run([&](pliant::Simulation& made) { pliant::write_state(path, made); });
           })
      .def("restore_bytes",
           [](Handle& handle, const py::bytes& bytes) {
             const std::string_view state(bytes);
             handle.run([&](pliant::Simulation& made) { pliant::restore_state(state, "state", made); });
           })
      .def("restore_state", [](Handle& handle, const std::filesystem::path& path) {
        handle.run([&](pliant::Simulation& made) { pliant::restore_state(path, made); });
      });
}

void bind_own(py::class_<Handle, std::shared_ptr<Handle>>& simulation) {
  simulation.def("add_own_constraints", [](Handle& handle, Index body, const std::string& type, py::object project,
                                           const Indices& stencils, const Numbers& reduction, const Numbers& measure,
                                           const Numbers& fields, double stiffness, const std::string& name) {
    pliant::Simulation& made = handle.idle();
    return static_cast<Index>(
        made.add_set(BodyId{body},
                     own_constraints(type, std::move(project), indices_in(made, BodyId{body}, stencils), reduction,
                                     measure, fields, stiffness),
                     type, name));
  });
  simulation.def("add_own_force",
                 [](Handle& handle, const std::string& type, py::object force, const std::string& name) {
                   return static_cast<Index>(handle.idle().add_force(own_force(type, std::move(force)), name));
                 });
}

}  // namespace

void bind_simulation(py::module_& module) {
  py::class_<Handle, std::shared_ptr<Handle>> simulation(module, "Simulation");
  simulation.def(py::init(&make_simulation))
      .def("add_body",
           [](Handle& handle, const pliant::Mesh& mesh, const py::dict& mass, const std::string& name, py::object start,
              py::object velocities, py::object material) {
             return add_body(handle, mesh, mass, {name, std::move(start), std::move(velocities), std::move(material)});
           })
      .def("add_material",
           [](Handle& handle, Index body, py::object material) {
             const PlacedMaterial made = read_material(material);
             pliant::add_material(handle.idle(), BodyId{body}, made.material, made.placement);
           })
      .def("carry_surface",
           [](Handle& handle, Index body, double stiffness, const std::string& name) {
             return static_cast<Index>(pliant::carry_surface(handle.idle(), BodyId{body}, stiffness, name));
           })
      .def("add",
           [](Handle& handle, std::optional<Index> body, const std::string& type, const py::dict& given,
              const std::string& name) { return option_type(type).add(handle.idle(), body_of(body), given, name); })
      .def("replace", [](Handle& handle, Index number, const std::string& type,
                         const py::dict& given) { option_type(type).replace(handle.idle(), number, given); })
      .def("options",
           [](const Handle& handle, const std::string& kind, Index number) {
             for (const auto& [name, type] : option_types()) {
               if (type->kind() != kind) continue;
               const py::object found = type->options(handle.idle(), number);
               if (!found.is_none()) return py::object(py::make_tuple(name, found));
             }
             return py::object(py::none());
           })
      .def("settings", [](const Handle& handle) { return options_to_python(handle.now().settings()); })
      .def("set_settings",
           [](Handle& handle, const py::dict& given) {
             pliant::Simulation& made = handle.idle();
             made.set_settings(read_options(given, nullptr, made.settings()));
           })
      .def("contact", [](const Handle& handle) { return options_to_python(handle.now().contact()); })
      .def("set_contact",
           [](Handle& handle, const py::dict& given) {
             pliant::Simulation& made = handle.idle();
             pliant::ContactSettings contact = made.contact();
             contact.surfaces = true;
             made.set_contact(read_options(given, nullptr, contact));
           })
      .def("body_contact",
           [](const Handle& handle, Index body) { return options_to_python(handle.now().contact(BodyId{body})); })
      .def("set_body_contact", [](Handle& handle, Index body, const py::dict& given) {
        pliant::Simulation& made = handle.idle();
        made.set_contact(BodyId{body}, read_options(given, nullptr, made.contact(BodyId{body})));
      });
  bind_state(simulation);
  bind_own(simulation);
  bind_changes(simulation);
  bind_results(simulation);
}

}  // namespace pliant_python
