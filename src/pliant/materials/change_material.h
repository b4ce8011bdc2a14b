#pragma once
// Another material for a body, while the simulation runs.
//
//     change_material(simulation, sheet, builtin_material("silk"));
#include <optional>

#include "pliant/materials/material_groups.h"

namespace pliant {

/// The threads of a body as they lie now: those of its first group of fibres, the defaults of one without.
MaterialPlacement present_placement(const Simulation& simulation, BodyId body);

/// The groups of a body that another material would take the place of, in the order in which they were added: what
/// resists stretch, shear, bending or a change of volume on all of it.
std::vector<GroupId> groups_of_material(const Simulation& simulation, BodyId body);

/// Whether another material would take the place of a group of its body.
bool goes_with_material(const Group& group);

/// Makes a body of another material: what there is of constraints on all of it that resist stretch, shear, bending or
/// a change of volume goes, whoever added them, and the groups of the material take their place, under the ids and
/// names of those that are called the same. Mass and friction are those of the material; where the body is, how fast,
/// pins, pulls, attachments and constraints on a selection stay. Vertices without an element keep their mass. Costs
/// what adding does. Returns the groups of the material, as add_material does; throws as that does, and has changed
/// nothing then. Without a placement the threads lie as they do.
std::vector<GroupId> change_material(Simulation& simulation, BodyId body, const Material& material,
                                     const std::optional<MaterialPlacement>& placement = {});

}  // namespace pliant
