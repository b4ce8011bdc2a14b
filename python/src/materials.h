#pragma once
// Materials as Python gives them: a name, or a dictionary with the name, numbers that differ, and how the material
// lies.
#include "convert.h"
#include "pliant/materials/material_groups.h"

namespace pliant_python {

struct PlacedMaterial {
  pliant::Material material;
  pliant::MaterialPlacement placement;
};

/// Throws Error(input) on a name that there is not, with the nearest ones, and on wrong numbers.
PlacedMaterial read_material(py::handle given);

}  // namespace pliant_python
