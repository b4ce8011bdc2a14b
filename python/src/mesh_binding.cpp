#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bindings.h"
#include "option_types.h"
#include "pliant/mesh/geometry.h"
#include "pliant/mesh/lattice.h"
#include "pliant/mesh/topology.h"
#include "pliant_io/mesh/mesh_file.h"
#include "typed_options.h"

namespace pliant_python {
namespace {

using pliant::Mesh;

Mesh make_mesh(py::handle vertices, py::handle triangles, py::handle tetrahedra, py::handle edges) {
  Mesh mesh;
  mesh.vertices = read_rows(vertices, "Mesh: vertices");
  if (!triangles.is_none()) mesh.triangles = read_elements<3>(triangles, "Mesh: triangles");
  if (!tetrahedra.is_none()) mesh.tetrahedra = read_elements<4>(tetrahedra, "Mesh: tetrahedra");
  if (!edges.is_none()) mesh.edges = read_elements<2>(edges, "Mesh: edges");
  check_mesh(mesh, "Mesh");
  return mesh;
}

template <class Element>
py::array_t<pliant::Index> elements_of(const std::vector<Element>& elements) {
  const auto width = static_cast<py::ssize_t>(std::tuple_size_v<Element>);
  const pliant::Index* const begin = elements.empty() ? nullptr : elements.front().data();
  return py::array_t<pliant::Index>({static_cast<py::ssize_t>(elements.size()), width}, begin);
}

py::array_t<pliant::Index> boundary(const Mesh& mesh) {
  const std::vector<pliant::Index> vertices = boundary_vertices(mesh);
  return py::array_t<pliant::Index>(static_cast<py::ssize_t>(vertices.size()), vertices.data());
}

void write(const Mesh& mesh, const std::filesystem::path& path, py::handle positions) {
  write_mesh(path, mesh, positions.is_none() ? mesh.vertices : read_rows(positions, "write: positions"));
}

}  // namespace

void bind_meshes(py::module_& module) {
  py::class_<Mesh>(module, "Mesh")
      .def(py::init(&make_mesh), py::arg("vertices"), py::arg("triangles") = py::none(), py::kw_only(),
           py::arg("tetrahedra") = py::none(), py::arg("edges") = py::none())
      .def_property_readonly("vertices", [](const Mesh& mesh) { return copied_rows(mesh.vertices); })
      .def_property_readonly("triangles", [](const Mesh& mesh) { return elements_of(mesh.triangles); })
      .def_property_readonly("tetrahedra", [](const Mesh& mesh) { return elements_of(mesh.tetrahedra); })
      .def_property_readonly("edges", [](const Mesh& mesh) { return elements_of(mesh.edges); })
      .def_property_readonly("unique_edges", [](const Mesh& mesh) { return elements_of(unique_edges(mesh)); })
      .def_property_readonly("boundary", &boundary)
      .def("write", &write, py::arg("path"), py::arg("positions") = py::none())
      .def("__repr__", [](const Mesh& mesh) {
        return "Mesh of " + std::to_string(mesh.vertex_count()) + " vertices, " +
               std::to_string(mesh.triangles.size()) + " triangles, " + std::to_string(mesh.tetrahedra.size()) +
               " tetrahedra, " + std::to_string(mesh.edges.size()) + " edges";
      });
  module.def("make_shape",
             [](const std::string& type, const py::dict& given) { return option_type(type).mesh(given); });
  module.def("read_mesh", [](const std::filesystem::path& path, const py::dict& given) {
    return pliant::read_mesh(path, read_options<pliant::ImportOptions>(given, nullptr));
  });
  module.def("lattice_solid", [](const Mesh& surface, const py::dict& given) {
    return pliant::lattice_solid(surface, read_options<pliant::LatticeOptions>(given, nullptr), "surface");
  });
}

void bind_types(py::module_& module) {
  module.def("describe_types", [] {
    py::dict all;
    for (const auto& [name, type] : option_types()) {
      py::dict described;
      described["kind"] = type->kind();
      described["scene_name"] = type->scene_name();
      described["summary"] = type->summary();
      described["fields"] = type->fields();
      all[py::str(name)] = described;
    }
    return all;
  });
  module.def("check_options", [](const std::string& type, const py::dict& given) { option_type(type).check(given); });
}

}  // namespace pliant_python
