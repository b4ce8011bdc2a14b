#pragma once
// The parts of the module, each in a source of its own.
#include "handle.h"

namespace pliant_python {

/// What a step tells about itself.
py::dict report_of(const pliant::StepReport& report);

void bind_types(py::module_& module);
void bind_meshes(py::module_& module);
void bind_simulation(py::module_& module);
void bind_changes(py::class_<Handle, std::shared_ptr<Handle>>& simulation);
void bind_results(py::class_<Handle, std::shared_ptr<Handle>>& simulation);
void bind_recordings(py::module_& module);
void bind_scenes(py::module_& module);

}  // namespace pliant_python
