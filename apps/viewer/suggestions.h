#pragma once
// How strong the mouse is, for the size and weight of what a scene has.
#include "pliant/simulation/simulation.h"

namespace pliant_viewer {

using pliant::Real;

/// A stiffness [N/m] with which the mouse can lift the scene's bodies while the spring stretches little.
Real suggest_pull_stiffness(const pliant::Simulation& simulation);

/// The most by which the mouse moves a collider [m/s].
Real suggest_collider_speed(const pliant::Simulation& simulation);

}  // namespace pliant_viewer
