// Steps, and what they leave.
#include <pybind11/stl.h>

#include "bindings.h"
#include "pliant/simulation/step_error.h"

namespace pliant_python {
namespace {

using pliant::BodyId;
using pliant::Index;
using pliant::Real;

using Class = py::class_<Handle, std::shared_ptr<Handle>>;

py::array_t<double> array_of(std::span<const Real> numbers) {
  return py::array_t<double>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

py::dict evaluation_of(const pliant::Evaluation& evaluation) {
  py::dict result;
  result["residual"] = evaluation.residual;
  result["inertia"] = evaluation.inertia;
  result["elastic"] = evaluation.elastic;
  result["outside"] = evaluation.outside;
  result["contact"] = evaluation.contact;
  result["objective"] = evaluation.objective();
  return result;
}

/// Arrays of what touches: vertex, collider, point, normal, distance, force, friction power.
py::tuple contacts(const Handle& handle) {
  const std::span<const pliant::ContactPoint> found = handle.idle().contacts();
  const auto count = static_cast<Eigen::Index>(found.size());
  std::vector<Index> vertices;
  std::vector<Index> colliders;
  std::vector<Real> distances;
  std::vector<Real> powers;
  pliant::Positions points(count, 3), normals(count, 3), forces(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const pliant::ContactPoint& each = found[static_cast<std::size_t>(i)];
    vertices.push_back(each.vertex);
    colliders.push_back(each.collider);
    distances.push_back(each.distance);
    powers.push_back(each.friction_power);
    points.row(i) = each.point.transpose();
    normals.row(i) = each.normal.transpose();
    forces.row(i) = each.force.transpose();
  }
  return py::make_tuple(py::array(py::cast(vertices)), py::array(py::cast(colliders)), copied_rows(points),
                        copied_rows(normals), array_of(distances), copied_rows(forces), array_of(powers));
}

py::tuple touches(const Handle& handle) {
  const std::vector<pliant::VertexTouch> found = handle.idle().touches();
  std::vector<Real> gaps;
  pliant::Positions forces(static_cast<Eigen::Index>(found.size()), 3);
  for (std::size_t i = 0; i < found.size(); ++i) {
    gaps.push_back(found[i].gap);
    forces.row(static_cast<Eigen::Index>(i)) = found[i].force.transpose();
  }
  return py::make_tuple(array_of(gaps), copied_rows(forces));
}

/// Of each batch: indices (count x n), coefficients (count x rows x n) and weights, stiffness times measure.
py::list batches(const Handle& handle) {
  py::list result;
  for (const auto& [id, group] : handle.idle().groups()) {
    for (const auto& batch : group.set.batches) {
      const pliant::GroupShape shape = batch->shape();
      const auto count = static_cast<py::ssize_t>(shape.count);
      std::vector<Real> weights(batch->rest_measure().begin(), batch->rest_measure().end());
      for (Real& weight : weights) weight *= batch->stiffness();
      const std::vector<Index> pinned(batch->pinned_vertices().begin(), batch->pinned_vertices().end());
      result.append(py::make_tuple(
          py::array_t<Index>({count, static_cast<py::ssize_t>(shape.vertices)}, batch->stencil().data()),
          py::array_t<double>({count, static_cast<py::ssize_t>(shape.rows), static_cast<py::ssize_t>(shape.vertices)},
                              batch->reduction().data()),
          array_of(weights), py::array(py::cast(pinned))));
    }
  }
  return result;
}

py::dict system_info(Handle& handle) {
  const pliant::SystemInfo info = handle.run([](pliant::Simulation& simulation) { return simulation.system_info(); });
  py::dict result;
  result["matrix_entries"] = info.matrix_entries;
  result["factor_entries"] = info.factor_entries;
  result["bytes"] = info.bytes;
  result["pinned_vertices"] = info.pinned_vertices;
  result["free_components"] = info.free_components.size();
  result["fastest_frequency"] = info.fastest_frequency;
  result["backend"] = std::string(handle.now().backend());
  return result;
}

void bind_energies(Class& simulation) {
  simulation
      .def("evaluate",
           [](Handle& handle) { return evaluation_of(handle.run([](pliant::Simulation& s) { return s.evaluate(); })); })
      .def("step_error",
           [](Handle& handle) {
             const std::optional<pliant::StepError> found =
                 handle.run([](pliant::Simulation& s) { return pliant::find_step_error(s); });
             if (!found) return py::object(py::none());
             return py::object(
                 py::make_tuple(static_cast<Index>(found->body), found->distance, found->acceleration, found->share));
           })
      .def("elastic_energy",
           [](const Handle& handle, Index group) { return handle.now().elastic_energy(pliant::GroupId{group}); })
      .def("potential_energy",
           [](const Handle& handle) {
             Real sum = 0;
             for (const auto& [id, force] : handle.idle().forces())
               sum += force->potential(handle.now().state().view());
             return sum;
           })
      .def("objective_history", [](const Handle& handle) { return array_of(handle.idle().objective_history()); })
      .def("batches", &batches)
      .def("system_info", &system_info);
}

void bind_bodies(Class& simulation) {
  simulation.def("body_count", [](const Handle& handle) { return handle.now().bodies().size(); })
      .def("body_name", [](const Handle& handle, Index body) { return handle.now().body(BodyId{body}).name; })
      .def("body_range",
           [](const Handle& handle, Index body) {
             const pliant::Body& found = handle.now().body(BodyId{body});
             return py::make_tuple(found.first_vertex, found.first_vertex + found.mesh.vertex_count());
           })
      .def("body_mesh", [](const Handle& handle, Index body) { return handle.now().body(BodyId{body}).mesh; });
}

}  // namespace

py::dict report_of(const pliant::StepReport& report) {
  py::dict result;
  result["iterations"] = report.iterations;
  result["backtracks"] = report.backtracks;
  result["reached_tolerance"] = report.reached_tolerance;
  result["residual"] = report.residual;
  result["seconds_local"] = report.seconds_local;
  result["seconds_global"] = report.seconds_global;
  result["seconds_factor"] = report.seconds_factor;
  result["seconds_total"] = report.seconds_total;
  result["contacts"] = report.contact.contacts;
  result["deepest"] = report.contact.deepest;
  result["pairs"] = report.contact.pairs;
  result["smallest_gap"] = report.contact.smallest_gap;
  result["momentum_lost"] = to_python(report.contact.momentum_lost);
  return result;
}

void bind_results(Class& simulation) {
  bind_energies(simulation);
  bind_bodies(simulation);
  simulation
      .def("step", [](Handle& handle) { return report_of(handle.run([](pliant::Simulation& s) { return s.step(); })); })
      .def_property_readonly("positions", &Handle::positions)
      .def_property_readonly("velocities", &Handle::velocities)
      .def_property_readonly("masses", [](const Handle& handle) { return array_of(handle.now().state().masses); })
      .def_property_readonly("time", [](const Handle& handle) { return handle.now().state().time; })
      .def_property_readonly("steps_taken", [](const Handle& handle) { return handle.now().state().step; })
      .def_property_readonly("warnings", [](const Handle& handle) { return handle.now().warnings(); })
      .def_property_readonly("thread_count", [](const Handle& handle) { return handle.now().thread_count(); })
      .def("contacts", &contacts)
      .def("touches", &touches)
      .def("wrench", [](const Handle& handle, Index collider) {
        const pliant::Wrench found = handle.idle().wrench(pliant::ColliderId{collider});
        return py::make_tuple(to_python(found.force), to_python(found.torque));
      });
}

}  // namespace pliant_python
