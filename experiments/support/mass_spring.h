#pragma once
// A simulation of springs and pins as plain numbers: what the other methods of the experiments work on.
#include <vector>

#include "pliant/simulation/simulation.h"

namespace pliant_experiments {

/// ½ k (‖x₁ − x₀‖ − L)²
struct Spring {
  pliant::Index from = 0;
  pliant::Index to = 0;
  double stiffness = 0;    ///< k [N/m], > 0
  double rest_length = 0;  ///< L [m], > 0
};

/// ½ k ‖xᵢ − t‖²
struct SoftPin {
  pliant::Index vertex = 0;
  double stiffness = 0;  ///< k [N/m], > 0
  pliant::Vec3 target = pliant::Vec3::Zero();
};

struct MassSpring {
  std::vector<double> masses;  ///< [kg], one a vertex
  std::vector<Spring> springs;
  std::vector<SoftPin> soft_pins;
  std::vector<char> is_pinned;  ///< one a vertex: it stays where it is

  pliant::Index vertex_count() const { return static_cast<pliant::Index>(masses.size()); }
};

/// Takes over masses, springs and pins, and all weights; hard pins hold their vertices. Throws Error(input) on groups
/// of other types than `edge_spring` and `position`.
MassSpring mass_spring(const pliant::Simulation& simulation);

/// One step of implicit Euler: q minimizes E(q) = 1/(2h²) ‖M^½ (q − s)‖² + Σ w/2 ‖z − p(z)‖².
struct EulerStep {
  double time_step = 0;         ///< h [s]
  pliant::Positions predicted;  ///< s = qₙ + h vₙ + h² M⁻¹ f, m × 3 [m]; pinned vertices stand still
};

/// The next step of a simulation, with its state and its forces as they are now.
EulerStep next_step(const pliant::Simulation& simulation, const MassSpring& model);

/// E(q) [J]
double objective(const MassSpring& model, const EulerStep& step, const pliant::Positions& q);

/// ∇E(q), m × 3 [N]; zero on pinned vertices.
pliant::Positions gradient(const MassSpring& model, const EulerStep& step, const pliant::Positions& q);

}  // namespace pliant_experiments
