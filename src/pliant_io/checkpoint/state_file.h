#pragma once
// The state of a simulation that a program has made by itself, in a file, to be gone on from later.
//
//     write_state("rope.state", simulation);
//
//     Simulation simulation = make_rope();        // as the program did before
//     restore_state("rope.state", simulation);    // the steps that follow have the same bits
//
// Simulations of scene files: checkpoint.h.
#include <filesystem>

#include "pliant/simulation/simulation.h"

namespace pliant {

/// Writes positions, velocities, step and time, stiffness and numbers of every group, where colliders are and what
/// friction remembers: not what bodies, constraints, forces and settings are. Whole or not at all (atomic_file.h).
/// @throws Error (output): the file cannot be written.
void write_state(const std::filesystem::path& path, const Simulation& simulation);

/// Takes a simulation to that state that has the same bodies, groups and colliders, added in the same order; forces and
/// settings are as the program has them. The steps that follow have the same bits as if it had gone on, by one build of
/// the library and on processors with the same instructions.
/// @throws Error (input), with the simulation as it was: no such file, cut, damaged, of another simulation.
void restore_state(const std::filesystem::path& path, Simulation& simulation);

/// The bytes of such a file.
std::string state_bytes(const Simulation& simulation);
/// `name` is what messages call them.
void restore_state(std::string_view bytes, std::string_view name, Simulation& simulation);

}  // namespace pliant
