#pragma once
// Changes that can be taken back: all of them or none.
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "pliant/simulation/simulation.h"

namespace pliant {

/// Takes back, when it ends, whatever was changed of a simulation since it began, unless commit() was called: bodies,
/// groups, forces, stiffnesses, targets, settings, a replaced state. Groups and forces that come back keep their ids.
/// It does not take back steps, nor what a program changed inside a group or a force by itself. The simulation must
/// stay where it is while this lives; one Transaction may live inside another.
///
///     Transaction transaction(simulation);
///     simulation.remove(pins);
///     simulation.step();  // throws: the pins are there again
///     transaction.commit();
class Transaction {
 public:
  explicit Transaction(Simulation& simulation);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;

  void commit() { is_committed_ = true; }

 private:
  friend class Simulation;
  friend class Colliders;

  /// What changes without a group being another one.
  struct Numbers {
    std::vector<Real> stiffnesses;          // of each batch
    std::vector<std::vector<Real>> points;  // of each batch
  };
  struct SavedForce {
    std::unique_ptr<Force> force;
    ForceRecord record;
  };

  // To be told before the first change of a thing, or with what was taken away; later ones are of no interest.
  void save_numbers(GroupId id, const Group& group);
  void save(GroupId id, std::optional<Group> group);
  void save(ForceId id, std::optional<SavedForce> force);
  void save_state();
  void save_colliders();
  void save_body_contacts();

  void roll_back();
  bool roll_back_bodies();
  void merge_into(Transaction& outer);

  Simulation& simulation_;
  Transaction* outer_;
  bool is_committed_ = false;
  // As they were when it began.
  SolverSettings settings_;
  std::size_t body_count_;
  std::size_t warning_count_;
  std::set<ForceId> warned_forces_;
  Index next_group_;
  Index next_force_;
  Index next_collider_;
  std::int64_t changed_step_;
  ContactSettings contact_settings_;
  // As they were before their first change; none for what was not there.
  std::map<GroupId, std::optional<Group>> groups_;
  std::map<GroupId, Numbers> numbers_;
  std::map<ForceId, std::optional<SavedForce>> forces_;
  std::optional<State> state_;
  std::optional<ContactState> contact_;  // unless the state was saved before
  std::optional<std::map<ColliderId, ColliderRecord>> colliders_;
  std::optional<std::vector<BodyContact>> body_contacts_;  // of the bodies that there were
};

}  // namespace pliant
