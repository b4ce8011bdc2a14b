#pragma once
// Meshes from a few numbers. Every function throws Error (input) that names the option when one is out of its range or
// when the shape would have more than max_shape_vertices. Units and ranges stand in the options' lists, `visit`.
#include "pliant/mesh/shapes/bar.h"
#include "pliant/mesh/shapes/chain.h"
#include "pliant/mesh/shapes/panel.h"
#include "pliant/mesh/shapes/sheets.h"
#include "pliant/mesh/shapes/surfaces.h"
#include "pliant/mesh/shapes/tube.h"
