#pragma once
// A run at a moment, in a file, to be taken up later.
//
//     write_checkpoint("curtain.pliant", scene);            // between two steps
//     Scene scene = read_checkpoint("curtain.pliant");      // there, or on another day
//     while (scene.simulation.state().step < scene.steps) scene.step();
//
// Simulations without a scene: state_file.h.
#include <filesystem>
#include <optional>

#include "pliant_io/scene/scene.h"

namespace pliant {

/// Writes all that the next step depends on: the texts of the scene and what was set in place of theirs, positions,
/// velocities, step and time, the numbers and the stiffness of every group, where colliders are and what friction on
/// them remembers, which events have acted, the motions under way; and of each mesh and map the size and the CRC-32.
/// The system matrix is summed and factorized anew from these. Whole or not at all (atomic_file.h).
/// @throws Error (output): the file cannot be written.
void write_checkpoint(const std::filesystem::path& path, const Scene& scene);

/// The bytes of such a file in `folder`.
std::string checkpoint_bytes(const Scene& scene, const std::filesystem::path& folder);

/// What may be another when a run is taken up; the bits of the results depend on none of it.
struct ResumeOptions {
  std::optional<std::int64_t> steps = {};  ///< in all, with those taken
  std::optional<Index> threads = {};       ///< as SolverSettings::threads; none: as the run has it
};

/// The scene as it was. The steps that follow have the same bits as if the run had gone on, by one build of the library
/// and on processors with the same instructions.
/// @throws Error (input), naming the file: not a checkpoint, cut, damaged, of another format; a mesh or map that is
///   missing or was changed since; fewer steps than were taken.
Scene read_checkpoint(const std::filesystem::path& path, const ResumeOptions& options = {});

/// The same for the bytes of such a file. `name` is what messages call it.
Scene parse_checkpoint(std::string_view bytes, std::string_view name, const ResumeOptions& options = {});

/// The scene as it was opened, before its first step: for a program that had added bodies, groups, forces or colliders
/// to it by then. It adds the same again, in the same order, and then takes the scene to the moment of the checkpoint.
Scene open_checkpoint(const std::filesystem::path& path, const ResumeOptions& options = {});
/// @throws Error (input): another scene, or not what had been added. The scene is then of no use.
void restore_checkpoint(Scene& scene, const std::filesystem::path& path);
/// Both for the bytes of such a file; `folder` is where that is, empty: nowhere.
Scene open_checkpoint(std::string_view bytes, std::string_view name, const std::filesystem::path& folder = {},
                      const ResumeOptions& options = {});
void restore_checkpoint(Scene& scene, std::string_view bytes, std::string_view name);

}  // namespace pliant
