#pragma once
// Everything that a first program needs of the algorithm; pliant_io/pliant_io.h has files.
#include "pliant/collision/colliders/builtin.h"
#include "pliant/constraints/builtin.h"
#include "pliant/core/error.h"
#include "pliant/forces/builtin.h"
#include "pliant/materials/material_groups.h"
#include "pliant/mesh/mass.h"
#include "pliant/mesh/shapes.h"
#include "pliant/mesh/topology.h"
#include "pliant/simulation/simulation.h"
#include "pliant/simulation/step_error.h"
#include "pliant/timeline/animated_body.h"
#include "pliant/timeline/timeline.h"
