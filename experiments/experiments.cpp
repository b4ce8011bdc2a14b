#include "experiments.h"

#include <array>

#include "contact/contact.h"
#include "convergence/convergence.h"
#include "damping/damping.h"
#include "explicit_euler/explicit_euler.h"
#include "hand/hand.h"
#include "integrators/integrators.h"
#include "iterations/iterations.h"
#include "performance/performance.h"
#include "resolution/resolution.h"
#include "sheet_metal/sheet_metal.h"
#include "start/start.h"
#include "torque/torque.h"
#include "torus/torus.h"
#include "wind/wind.h"

namespace pliant_experiments {

std::span<const Experiment> experiments() {
  static constexpr std::array list = {
      Experiment{"wind", "Extreme wind", run_wind},
      Experiment{"explicit_euler", "Explicit Euler, for contrast", run_explicit_euler},
      Experiment{"torus", "A torus with jumping pins", run_torus},
      Experiment{"damping", "Damping by the number of iterations", run_damping},
      Experiment{"sheet_metal", "Sheet metal and cloth", run_sheet_metal},
      Experiment{"hand", "A closed body under strong forces", run_hand},
      Experiment{"torque", "Rotation under a torque", run_torque},
      Experiment{"start", "Where the iterations begin", run_start},
      Experiment{"performance", "Performance", run_performance},
      Experiment{"convergence", "Convergence against Newton's method", run_convergence},
      Experiment{"resolution", "One cloth in four resolutions and two orientations", run_resolution},
      Experiment{"iterations", "Dependence on the iterations, against XPBD", run_iterations},
      Experiment{"integrators", "Less damping, and more: integrators on the same factor", run_integrators},
      Experiment{"contact", "Contact: friction, impacts, convergence and cost", run_contact},
  };
  return list;
}

}  // namespace pliant_experiments
