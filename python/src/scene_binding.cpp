#include <filesystem>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bindings.h"
#include "pliant/materials/material.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/files/read_file.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "pliant_io/scene/schema.h"
#include "scene_run.h"

namespace pliant_python {
namespace {

/// A scene with its simulation as Python holds it.
struct SceneHandle {
  explicit SceneHandle(pliant::Scene read)
      : scene(std::make_shared<pliant::Scene>(std::move(read))),
        simulation(std::make_shared<Handle>(std::shared_ptr<pliant::Simulation>(scene, &scene->simulation))) {}

  std::shared_ptr<pliant::Scene> scene;
  std::shared_ptr<Handle> simulation;
};

pliant::SceneOverrides overrides_of(const std::vector<std::string>& set) {
  pliant::SceneOverrides overrides;
  overrides.set = set;
  return overrides;
}

void save(const SceneHandle& handle, const std::filesystem::path& path) {
  handle.simulation->idle();
  pliant::write_checkpoint(path, *handle.scene);
}

void bind_lists(py::module_& module) {
  module.def("scene_names", [] {
    std::vector<std::string> names;
    for (const pliant::BuiltinScene& scene : pliant::builtin_scenes()) names.emplace_back(scene.name);
    return names;
  });
  module.def("material_names", [] {
    std::vector<std::string> names;
    for (const pliant::Material& material : pliant::builtin_materials()) names.push_back(material.name);
    return names;
  });
  module.def("scene_schema", &pliant::scene_schema);
}

}  // namespace

void bind_scenes(py::module_& module) {
  bind_lists(module);
  py::class_<SceneHandle>(module, "Scene")
      .def_readonly("simulation", &SceneHandle::simulation)
      .def_property_readonly("name", [](const SceneHandle& handle) { return handle.scene->name; })
      .def_property_readonly("description", [](const SceneHandle& handle) { return handle.scene->description; })
      .def_property_readonly("steps", [](const SceneHandle& handle) { return handle.scene->steps; })
      .def_property_readonly("warnings", [](const SceneHandle& handle) { return handle.scene->warnings; })
      .def("step", [](SceneHandle& handle) { handle.simulation->run([&](auto&) { handle.scene->step(); }); })
      .def("run",
           [](SceneHandle& handle, const std::filesystem::path& folder, std::int64_t steps) {
             handle.simulation->run([&](auto&) { run_scene(*handle.scene, folder, steps); });
           })
      .def("save", &save)
      .def("restore", [](const SceneHandle& handle, const py::bytes& bytes, const std::string& name) {
        const std::string_view content(bytes);
        handle.simulation->run([&](auto&) { pliant::restore_checkpoint(*handle.scene, content, name); });
      });
  module.def("open_scene", [](const std::string& name, const std::vector<std::string>& set) {
    return SceneHandle(open_scene(name, overrides_of(set)));
  });
  module.def("parse_scene",
             [](const std::string& text, const std::filesystem::path& folder, const std::vector<std::string>& set) {
               return SceneHandle(pliant::parse_scene(text, folder, "scene", overrides_of(set)));
             });
  module.def("read_file", [](const std::filesystem::path& path) { return py::bytes(pliant::read_file(path)); });
  module.def("open_checkpoint",
             [](const py::bytes& bytes, const std::string& name, const std::filesystem::path& folder) {
               return SceneHandle(pliant::open_checkpoint(std::string_view(bytes), name, folder));
             });
}

}  // namespace pliant_python
