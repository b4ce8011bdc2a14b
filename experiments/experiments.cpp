#include "experiments.h"

#include <array>
#include <string>
#include <utility>

#include "contact/contact.h"
#include "convergence/convergence.h"
#include "damping/damping.h"
#include "explicit_euler/explicit_euler.h"
#include "folds/folds.h"
#include "hand/hand.h"
#include "integrators/integrators.h"
#include "iterations/iterations.h"
#include "performance/performance.h"
#include "reduction/reduction.h"
#include "resolution/resolution.h"
#include "sheet_metal/sheet_metal.h"
#include "start/start.h"
#include "torque/torque.h"
#include "torus/torus.h"
#include "twitching/twitching.h"
#include "wave_front/wave_front.h"
#include "wind/wind.h"

namespace pliant_experiments {

std::span<const Experiment> experiments() {
  static constexpr std::array list = {
      Experiment{"wind", "Extreme wind", run_wind},
      Experiment{"explicit_euler", "Explicit Euler, for contrast", run_explicit_euler},
      Experiment{"torus", "A torus with jumping pins", run_torus},
      Experiment{"damping", "Damping by the number of iterations", run_damping},
      Experiment{"sheet_metal", "Sheet metal and cloth", run_sheet_metal},
      Experiment{"wave_front", "The wave after a release", run_wave_front},
      Experiment{"folds", "Folds by the number of iterations", run_folds},
      Experiment{"hand", "A closed body under strong forces", run_hand},
      Experiment{"torque", "Rotation under a torque", run_torque},
      Experiment{"start", "Where the iterations begin", run_start},
      Experiment{"twitching", "Twitching with one iteration", run_twitching},
      Experiment{"reduction", "Edges with A = I: changes spread only slowly", run_reduction},
      Experiment{"performance", "Performance", run_performance},
      Experiment{"convergence", "Convergence against Newton's method", run_convergence},
      Experiment{"resolution", "One cloth in four resolutions and two orientations", run_resolution},
      Experiment{"iterations", "Dependence on the iterations, against XPBD", run_iterations},
      Experiment{"integrators", "Less damping, and more: integrators on the same factor", run_integrators},
      Experiment{"contact", "Contact: friction, impacts, convergence and cost", run_contact},
  };
  return list;
}

std::vector<std::pair<std::string, std::string>> sources() {
  return {
      {"thesis",
       "T. Kenneweg, Projective Dynamics. Bachelor's thesis, Bielefeld University, 15 December 2014. Chapter 6 gives "
       "figures and words and almost no parameters: where a set-up has numbers here, they are ours, chosen to be like "
       "its pictures. Its Fig. 6.1 is “Extreme wind”, 6.2 “A torus with jumping pins”, 6.3 to 6.6 “Damping”, 6.7 left "
       "“Sheet metal and cloth” and right “The wave after a release”; Sec. 6.3 is “Folds”, “A closed body” and "
       "“Rotation”, Sec. 6.4 “Where the iterations begin” and “Twitching”, Sec. 6.5 “Performance”, Sec. 4.4.3 “Edges "
       "with A = I”. The 60 steps a second that “Performance” compares with are those of Sec. 6.5."},
      {"Bouaziz et al. 2014",
       "S. Bouaziz, S. Martin, T. Liu, L. Kavan, M. Pauly, Projective Dynamics: Fusing Constraint Projections for Fast "
       "Simulation. ACM Transactions on Graphics 33(4), 154. What is compared are its statements, on scenes of ours: "
       "convergence against Newton's method, and independence of stiffness from iterations and of behavior from the "
       "mesh. None of its numbers is used."},
      {"Macklin et al. 2016",
       "M. Macklin, M. Müller, N. Chentanez, XPBD: Position-Based Simulation of Compliant Constrained Dynamics. Motion "
       "in Games 2016, 49–54. Its algorithm was written anew for these experiments (experiments/support/xpbd.cpp)."},
      {"PBD",
       "M. Müller, B. Heidelberger, M. Hennix, J. Ratcliff, Position Based Dynamics. Journal of Visual Communication "
       "and Image Representation 18(2), 109–118, 2007. Written anew as well."},
      {"an independent program",
       "A separate solver that shares no code with Pliant, run once for the set-ups of this report. The figures in the "
       "columns “independent program” are its own, and stand in the sources of the experiments."},
      {"no source", "Claims without one are ours."},
  };
}

}  // namespace pliant_experiments
