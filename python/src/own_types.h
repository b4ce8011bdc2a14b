#pragma once
// Constraints and forces that are written in Python, for many at once with NumPy.
#include "convert.h"

namespace pliant_python {

/// One batch of constraints whose projection is a callable of Python: `project(z, fields)` with z of shape
/// (count, rows, 3) and the rest data of the same constraints, (count, f); it returns p in the shape of z.
/// `indices` (count x n) are those of the simulation; `reduction` is count x rows x n.
pliant::ConstraintSet own_constraints(const std::string& type, py::object project, const Indices& indices,
                                      const Numbers& reduction, const Numbers& measure, const Numbers& fields,
                                      double stiffness);

/// A force that asks `force(positions, velocities, masses, time, time_step)` for m x 3 numbers [N].
std::unique_ptr<pliant::Force> own_force(const std::string& type, py::object force);

}  // namespace pliant_python
