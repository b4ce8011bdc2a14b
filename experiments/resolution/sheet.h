#pragma once
// One sheet of the experiment, brought to rest.
#include <string>

#include "experiment_context.h"

namespace pliant_experiments {

/// What the sheet is made of: a scene of this experiment.
struct Material {
  std::string scene;  ///< "springs"
  std::string name;   ///< "springs of constant k"
  int color = 0;      ///< in plots
};

/// How fine, and how the cells are cut: a value of the grid's `diagonals`.
struct Tessellation {
  int vertices_a_side = 21;
  std::string diagonals = "forward";
};

/// The scene, hung by its upper edge, at rest.
pliant::Scene hung(const ExperimentContext& context, const Material& material, const Tessellation& tessellation);

/// Where the middle of the lower edge has come: x aside, and z down, both from its place without a load [m].
struct Drop {
  double aside = 0;
  double down = 0;
};
Drop drop(const pliant::Scene& scene);

/// The sheet without weight and rail, pulled at its whole border by a tension in one direction, at rest. It then has
/// the same tension everywhere, so that every mesh of one and the same continuum has one and the same strain.
/// `degrees` from the first axis to the second, tension in N/m.
pliant::Scene pulled(const ExperimentContext& context, const Material& material, const Tessellation& tessellation,
                     double degrees, double tension);

/// The mean strain of the sheet along that direction: how much longer it is there, of its length.
double elongation(const pliant::Scene& scene, double degrees);

}  // namespace pliant_experiments
