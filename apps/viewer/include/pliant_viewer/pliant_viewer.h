#pragma once
// The window for a program's own simulations: play, pull, pin, change every option, plot, film.
//
//     Simulation simulation;
//     ... bodies, constraints, forces ...
//     view(simulation);
//
// Types of the program's own show the options that their visit() names, like the built-in ones. Link pliant::viewer.
#include <functional>

#include "pliant_io/scene/scene.h"

namespace pliant {

struct ViewOptions {
  /// Begin paused; the space bar goes on.
  bool paused = false;
  /// Called before each step, on the thread that takes the steps: the place to move targets, colliders and forces from
  /// a program. What it throws is shown in the window, which pauses.
  std::function<void(Simulation&)> before_step{};
  /// Called on the same thread after a restart, with the simulation as it was when the window opened.
  std::function<void(Simulation&)> restarted{};
  /// Asked several times a second, on the thread of view(), whether the window is to close. None: its user closes it.
  std::function<bool()> should_close{};
};

/// Opens a window in which the simulation goes on, and returns once it is closed. The simulation is then where the
/// window has left it, with what was changed there; ids are those of before, but for what was switched off. It starts
/// over, and takes back changes of other things than numbers, from a copy that is made first (Simulation::copy); types
/// without copy() do without both. Its set_stop() is none afterwards. To be called on the main thread, and not from
/// within itself. Throws Error(input), with the simulation as it was, where there is no display with OpenGL 3.3.
void view(Simulation& simulation, const ViewOptions& options = {});

/// The same of a scene: with its name, events, materials, colors and camera. One that was read from a file, and not
/// changed since, can be saved from the window.
void view(Scene& scene, const ViewOptions& options = {});

}  // namespace pliant
