// Changes between steps.
#include <cmath>

#include <pybind11/stl.h>

#include "bindings.h"

namespace pliant_python {
namespace {

using pliant::ColliderId;
using pliant::ForceId;
using pliant::GroupId;
using pliant::Index;

using Class = py::class_<Handle, std::shared_ptr<Handle>>;

py::array_t<double> targets(const Handle& handle, Index number) {
  const pliant::Simulation& simulation = handle.now();
  const GroupId group{number};
  pliant::Positions rows(simulation.target_count(group), 3);
  for (Index i = 0; i < rows.rows(); ++i) rows.row(i) = simulation.target(group, i).transpose();
  return copied_rows(rows);
}

void set_targets(Handle& handle, Index number, py::handle given) {
  pliant::Simulation& simulation = handle.idle();
  const GroupId group{number};
  const pliant::Positions rows = read_rows(given, "targets");
  if (rows.rows() != simulation.target_count(group)) {
    pliant::fail_input("targets: found " + std::to_string(rows.rows()) + " rows; the group has " +
                       std::to_string(simulation.target_count(group)) + " targets, give a row for each");
  }
  if (!rows.allFinite()) pliant::fail_input("targets: a number is not finite; give finite ones [m]");
  for (Index i = 0; i < rows.rows(); ++i) simulation.set_target(group, i, pliant::row(rows, i));
}

py::tuple pose(const Handle& handle, Index number) {
  const pliant::Pose& found = handle.now().pose(ColliderId{number});
  const pliant::Quaternion& q = found.rotation;
  return py::make_tuple(to_python(found.position), py::make_tuple(q.w(), q.x(), q.y(), q.z()));
}

/// In the coordinates of the simulation; what has no end up to `size` [m].
pliant::Mesh collider_surface(const Handle& handle, Index number, double size) {
  if (!(size > 0) || !std::isfinite(size)) {
    pliant::fail_input("size: " + std::to_string(size) + " is out of range; give one above 0 [m]");
  }
  const pliant::Pose& pose = handle.now().pose(ColliderId{number});
  pliant::Mesh surface = handle.now().collider(ColliderId{number}).shape->surface(size);
  for (Eigen::Index i = 0; i < surface.vertices.rows(); ++i) {
    const pliant::Vec3 point = surface.vertices.row(i).transpose();
    surface.vertices.row(i) = (pose.position + pose.rotation * point).transpose();
  }
  return surface;
}

void set_collider_target(Handle& handle, Index number, const std::array<double, 3>& position,
                         const std::optional<std::array<double, 4>>& rotation) {
  const ColliderId id{number};
  pliant::Pose target = handle.idle().pose(id);
  target.position = pliant::Vec3(position[0], position[1], position[2]);
  if (rotation) {
    const auto& [w, x, y, z] = *rotation;
    const pliant::Quaternion turned(w, x, y, z);
    if (!(turned.norm() > 0) || !std::isfinite(turned.norm())) {
      pliant::fail_input("set_target: rotation: no quaternion; give (w, x, y, z) of length 1");
    }
    target.rotation = turned.normalized();
  }
  handle.idle().set_target(id, target);
}

void bind_kind(Class& simulation, const std::string& kind, auto name_of, auto find, auto remove) {
  simulation.def((kind + "_name").c_str(), name_of)
      .def(("find_" + kind).c_str(), find)
      .def(("remove_" + kind).c_str(), remove);
}

template <class Id>
std::optional<Index> number_of(std::optional<Id> id) {
  return id ? std::optional(static_cast<Index>(*id)) : std::nullopt;
}

const pliant::Group& group_at(const Handle& handle, Index number) {
  const auto found = handle.now().groups().find(GroupId{number});
  if (found == handle.now().groups().end()) pliant::fail_input("the group no longer exists");
  return found->second;
}

void bind_kinds(Class& simulation) {
  bind_kind(
      simulation, "group", [](const Handle& handle, Index number) { return group_at(handle, number).name; },
      [](const Handle& handle, const std::string& name) { return number_of(handle.now().find_group(name)); },
      [](Handle& handle, Index number) { handle.idle().remove(GroupId{number}); });
  bind_kind(
      simulation, "force", [](const Handle& handle, Index number) { return handle.now().name(ForceId{number}); },
      [](const Handle& handle, const std::string& name) { return number_of(handle.now().find_force(name)); },
      [](Handle& handle, Index number) { handle.idle().remove(ForceId{number}); });
  bind_kind(
      simulation, "collider", [](const Handle& handle, Index number) { return handle.now().name(ColliderId{number}); },
      [](const Handle& handle, const std::string& name) { return number_of(handle.now().find_collider(name)); },
      [](Handle& handle, Index number) { handle.idle().remove(ColliderId{number}); });
  const auto numbers = [](const auto& list) {
    std::vector<Index> result;
    for (const auto& [id, value] : list) result.push_back(static_cast<Index>(id));
    return result;
  };
  simulation.def("groups", [numbers](const Handle& handle) { return numbers(handle.now().groups()); })
      .def("forces", [numbers](const Handle& handle) { return numbers(handle.now().forces()); })
      .def("colliders", [numbers](const Handle& handle) { return numbers(handle.now().colliders()); })
      .def("group_type", [](const Handle& handle, Index number) { return group_at(handle, number).type; })
      .def("group_count", [](const Handle& handle, Index number) { return group_at(handle, number).set.count; })
      .def("group_body",
           [](const Handle& handle, Index number) { return static_cast<Index>(group_at(handle, number).body); });
}

}  // namespace

void bind_changes(Class& simulation) {
  bind_kinds(simulation);
  simulation.def("targets", &targets)
      .def("set_targets", &set_targets)
      .def("stiffness", [](const Handle& handle, Index number) { return handle.now().stiffness(GroupId{number}); })
      .def("set_stiffness", [](Handle& handle, Index number,
                               double stiffness) { handle.idle().set_stiffness(GroupId{number}, stiffness); })
      .def("set_stiffness_factors",
           [](Handle& handle, Index number, py::handle given) {
             const Numbers factors = Numbers::ensure(given);
             if (!factors || factors.ndim() != 1) {
               PyErr_Clear();
               pliant::fail_input(
                   "factors of the stiffness: give an array of one dimension with a number for each vertex");
             }
             handle.idle().set_stiffness_factors(GroupId{number}, {factors.data(), factors.data() + factors.size()});
           })
      .def("release", [](Handle& handle, Index number,
                         const std::vector<Index>& vertices) { handle.idle().release(GroupId{number}, vertices); })
      .def("pose", &pose)
      .def("collider_surface", &collider_surface)
      .def("set_collider_target", &set_collider_target)
      .def("set_state", [](Handle& handle, py::handle positions, py::handle velocities) {
        handle.idle().set_state(read_rows(positions, "set_state: positions"),
                                read_rows(velocities, "set_state: velocities"));
      });
}

}  // namespace pliant_python
