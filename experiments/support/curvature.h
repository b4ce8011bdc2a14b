#pragma once
// How much a sheet is folded.
#include "experiment_context.h"
#include "pliant/constraints/builtin.h"

namespace pliant_experiments {

/// ∫ ‖Δq‖² dA of a sheet, from the energy of a bending of 1 N m: twice that.
class CurvatureMeter {
 public:
  /// Of sheets with the mesh of that scene's first body, which has to be their only one.
  CurvatureMeter(const ExperimentContext& context, std::string_view scene)
      : scene_(context.scene(scene)),
        group_(scene_.simulation.add(pliant::BodyId{0}, pliant::Bending{.stiffness = 1})) {}

  double measure(const pliant::Simulation& sheet) {
    scene_.simulation.restore(sheet.state());
    scene_.simulation.evaluate();
    return 2 * scene_.simulation.elastic_energy(group_);
  }

 private:
  pliant::Scene scene_;
  pliant::GroupId group_;
};

}  // namespace pliant_experiments
