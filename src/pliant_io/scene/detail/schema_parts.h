#pragma once
// The parts of the schema that are lists of types, each where its reader is known.
#include "pliant_io/scene/detail/schema_options.h"

namespace pliant {

/// A string that means this.
SchemaJson text_schema(std::string_view description);
/// A mesh and a constraint of a body.
SchemaJson mesh_schema();
SchemaJson constraint_schema();
SchemaJson mass_schema();
SchemaJson gravity_schema();
SchemaJson body_material_schema();
SchemaJson materials_schema();

/// Definitions: what meshes, constraints, forces and colliders there are ("mesh", "mesh_part", "constraint", "force",
/// "contact", "collider"), and entries of "moves" and "events" ("timed_move", "event").
SchemaJson part_definitions();
SchemaJson event_definitions();

}  // namespace pliant
