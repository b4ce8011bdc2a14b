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
  /// Called before each step, on the thread that takes the steps, with the simulation that is shown: the place to move
  /// targets, colliders and forces from a program. A step that was given up for a change is taken again, and this
  /// called again: go by state().step and time. What it throws is shown in the window, which pauses.
  std::function<void(Simulation&)> before_step{};
  /// Called on the same thread before the first step after a restart: the simulation is where it was when the window
  /// opened, with what its user has changed in it, or without.
  std::function<void(Simulation&)> restarted{};
  /// Called on the same thread before the first step after a change that makes the simulation anew, as taking back a
  /// pin does: ids are those of before, but what before_step has added is gone.
  std::function<void(Simulation&)> rebuilt{};
  /// Asked several times a second, on the thread of view(), whether the window is to close. None: its user closes it.
  std::function<bool()> should_close{};
};

/// Opens a window in which the simulation goes on, and returns once it is closed. Meanwhile the simulation is the
/// window's; the one given here is empty. Afterwards it is where the window has left it, with what was changed there,
/// and ids are those of before, but for what was switched off. It starts over, and takes back changes of other things
/// than numbers, from a copy that is made first (Simulation::copy); types without copy() do without both. References
/// into it, as to a force of one's own, do not survive that, and its set_stop() is none afterwards. To be called on the
/// main thread, and not from within itself. Throws Error(input), with the simulation as it was, where there is no
/// display with OpenGL 3.3.
void view(Simulation& simulation, const ViewOptions& options = {});

/// The same of a scene: with its name, events, materials, colors and camera. One that was read from a file, and that
/// neither its program nor these functions change, can be saved from the window; groups may then have other ids.
void view(Scene& scene, const ViewOptions& options = {});

}  // namespace pliant
