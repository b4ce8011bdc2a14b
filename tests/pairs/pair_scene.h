#pragma once
// Scenes by which contact between surfaces is judged. Each is made for a number of vertices, so that a test can run it
// small and `contact_scenes` large, and begins without a crossing.
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "pliant/pliant.h"

namespace pliant_tests {

struct PairOptions {
  pliant::Index vertices = 300;  ///< about so many in all
  pliant::SolverSettings settings{.iterations = 10, .threads = 1};
  pliant::ContactSettings contact{.friction = 0.3, .surfaces = true};
  pliant::Real distance_scale = 1;  ///< contact distances are so many times the usual ones
  pliant::Real speed = 0;           ///< what falls begins downward with it [m/s]
  pliant::Real drag = 0;            ///< [N/m]: a vertex of the last body is dragged about; 0: none is
  std::uint64_t seed = 1;           ///< of the scenes that are drawn by chance
  pliant::Real turn = 1.2;          ///< in which a figure turns once about itself [s]
};

struct PairScene {
  pliant::Simulation simulation;
  pliant::Real duration = 0;                                ///< [s]
  std::function<void(pliant::Simulation&)> move = nullptr;  ///< pins and colliders, before each step; may be empty
  /// Takes a step; empty: Simulation::step().
  std::function<pliant::StepReport(pliant::Simulation&)> take = nullptr;

  pliant::Index frames() const;  ///< steps that the duration takes
  pliant::StepReport step();     ///< moves what is moved, then takes a step
};

/// What can be run by its name.
struct PairSceneEntry {
  std::string_view name;
  std::string_view about;
  PairScene (*make)(const PairOptions&);
};
std::span<const PairSceneEntry> pair_scenes();
/// Throws Error(input) on a name that there is not.
PairScene make_pair_scene(std::string_view name, const PairOptions& options);

/// Crossings of all surfaces and ropes of a simulation, by the exact checker, but for those between what is pinned, of
/// bodies that ignore each other or themselves, and of features that a tie joins, which are neighbors: a line crosses
/// the sail that it is tied to by what the tie gives.
std::int64_t count_crossings(const pliant::Simulation& simulation);
/// Those of which a vertex of the edge and one of the triangle have not been let go.
std::int64_t count_unknown_crossings(const pliant::Simulation& simulation);

/// Kinetic, elastic and potential energy [J], without that of contact.
pliant::Real total_energy(pliant::Simulation& simulation);
/// The root of the mean square of all speeds [m/s].
pliant::Real rms_speed(const pliant::Simulation& simulation);

}  // namespace pliant_tests
