#pragma once
// The parts of the schema that are lists of types, each where its reader is known.
#include "pliant_io/scene/detail/schema_options.h"

namespace pliant {

/// A string that means this.
SchemaJson text_schema(std::string_view description);
SchemaJson mesh_schema();
SchemaJson mesh_part_schema();
SchemaJson mass_schema();
SchemaJson constraint_schema();
SchemaJson force_schema();
/// Entries of "moves" and of "events".
SchemaJson move_schema();
SchemaJson event_schema();

}  // namespace pliant
