#pragma once
// The list of built-in forces: scene files, their schema, the tables of the docs, the sliders and every other interface
// are written over it. A new force is its pair of files, and here its include and its place in the list.
#include <tuple>

#include "pliant/forces/gravity.h"
#include "pliant/forces/mouse_spring.h"
#include "pliant/forces/pressure.h"
#include "pliant/forces/test_force.h"
#include "pliant/forces/wind.h"

namespace pliant {

using BuiltinForces = std::tuple<Wind, TestForce, MouseSpring, Pressure, Gravity>;

}  // namespace pliant
