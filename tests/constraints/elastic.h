#pragma once
// Constraints of one body outside a simulation: their energy and forces at any positions.
#include <string_view>

#include "pliant/constraints/constraint_set.h"
#include "pliant/solver/local/local_step.h"

namespace pliant_tests {

class Elastic {
 public:
  template <class Constraint>
  Elastic(const pliant::Mesh& mesh, const Constraint& options)
      : set_(build(pliant::BodyView{mesh, mesh.vertices, 0, "body"}, options)),
        no_inertia_(static_cast<std::size_t>(mesh.vertex_count()), 0),
        none_held_(static_cast<std::size_t>(mesh.vertex_count()), 0) {
    for (const auto& batch : set_.batches) groups_.push_back(batch.get());
    local_step_.set_groups(mesh.vertex_count(), groups_);
  }

  const pliant::ConstraintSet& set() const { return set_; }

  /// What a simulation does at the start of a step from q.
  void begin_step(const pliant::Positions& q) {
    const std::vector<pliant::Real> masses(static_cast<std::size_t>(q.rows()), 1);
    const pliant::Positions still = pliant::Positions::Zero(q.rows(), 3);
    for (pliant::ConstraintGroup* group : groups_) group->begin_step({q, still, masses, 0, 0}, 1);
  }

  pliant::Real energy(const pliant::Positions& q) { return run(q).elastic; }

  pliant::Positions forces(const pliant::Positions& q) {
    run(q);
    return forces_;
  }

 private:
  pliant::LocalResult run(const pliant::Positions& q) {
    forces_.resize(q.rows(), 3);
    return local_step_.run(q, q, no_inertia_, none_held_, forces_, threads_);
  }

  pliant::ConstraintSet set_;
  std::vector<pliant::ConstraintGroup*> groups_;
  pliant::LocalStep local_step_;
  pliant::ThreadPool threads_{1};
  std::vector<pliant::Real> no_inertia_;
  std::vector<char> none_held_;
  pliant::Positions forces_;
};

/// (x R + t) for every row: the body turned by R, then moved.
inline pliant::Positions moved(const pliant::Positions& x, const pliant::Mat3& R, const pliant::Vec3& t) {
  return (x * R.transpose()).rowwise() + t.transpose();
}

}  // namespace pliant_tests
