#pragma once
// A surface carried by a lattice of tetrahedra (lattice.h), in a simulation.
//
// Its vertices are vertices of the body like others, each tied to the place in its tetrahedron where it lies at rest:
// E = w/2 ‖x − Σ bⱼ xⱼ‖², w = k A/a, with A the area of the vertex and a the side of the lattice's cubes. What touches,
// pins or pulls them has its forces on the lattice by the same weights. The energy is quadratic with a projection that
// is always zero: the global step has it exactly, so that stiff ties cost no iterations.
#include "pliant/simulation/simulation.h"

namespace pliant {

/// Of ties, in units of what the body resists strain with: under a pressure of a hundredth of that modulus, vertices
/// depart from their places by a thousandth of the spacing.
inline constexpr Real tie_ratio = 10;
/// Of ties of a body whose tetrahedra resist nothing [Pa].
inline constexpr Real usual_tie_stiffness = 1e6;

/// Sum of the stiffnesses of the groups of tetrahedra on a body, of each the largest [Pa].
Real tetrahedron_stiffness(const Simulation& simulation, BodyId body);

/// Ties the surface of a body made by lattice_solid, in a group of type "attachment" named "BODY.surface" unless there
/// is a name. `stiffness` k [Pa] > 0; 0: tie_ratio times tetrahedron_stiffness, so add the constraints first. Throws
/// Error(input) on a body that carries no surface, a stiffness out of range.
GroupId carry_surface(Simulation& simulation, BodyId body, Real stiffness = 0, std::string name = {});

/// How far surface vertices are from their places in the lattice at most [m]; 0 of a body that carries none.
Real largest_departure(const Simulation& simulation, BodyId body);

}  // namespace pliant
