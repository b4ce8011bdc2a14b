// The module _pliant: what the package pliant is written over.
#include "bindings.h"
#include "pliant/core/version.h"

namespace {

/// pliant.Error, with its message and its kind.
void raise_as_python(std::exception_ptr thrown) {
  namespace py = pybind11;
  try {
    std::rethrow_exception(thrown);
  } catch (const pliant::Error& error) {
    const char* kind = "input";
    if (error.kind() == pliant::ErrorKind::diverged) kind = "diverged";
    if (error.kind() == pliant::ErrorKind::output) kind = "output";
    if (error.kind() == pliant::ErrorKind::interrupted) kind = "interrupted";
    const py::object type = py::module_::import("pliant._error").attr("Error");
    const py::object value = type(py::str(error.what()), kind);
    PyErr_SetObject(type.ptr(), value.ptr());
  }
}

}  // namespace

PYBIND11_MODULE(_pliant, module) {
  module.doc() = "What the package pliant is written over; use that.";
  pybind11::register_exception_translator(raise_as_python);
  module.attr("version") = std::string(pliant::version);
  pliant_python::bind_types(module);
  pliant_python::bind_meshes(module);
  pliant_python::bind_simulation(module);
  pliant_python::bind_recordings(module);
  pliant_python::bind_scenes(module);
}
