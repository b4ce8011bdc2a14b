#pragma once
// From iterate to iterate where a plain global step does not do: with acceleration, which must be watched, and with
// contact and energies that are no projections, to which the factor is no bound. Of each move the objective is seen
// where it led; one that has raised it is taken back, made plainly, and then shortened.
#include <optional>

#include "pliant/solver/acceleration/anderson.h"
#include "pliant/solver/acceleration/chebyshev.h"
#include "pliant/solver/acceleration/lbfgs.h"
#include "pliant/solver/rigid_balance.h"

namespace pliant {

class Descent {
 public:
  /// A substep begins.
  void begin(const StepContext& context);
  /// Whether its moves are to be made in place of plain global steps.
  bool is_needed() const { return is_accelerated_ || checks_plain_moves_; }
  /// What the local step finds at the iterate, after moves have been taken back that must be.
  LocalResult local_step(const StepContext& context, WorkingState& work, StepReport& report);
  /// Moves free components that touch something rigidly to where they are in balance.
  void settle(const StepContext& context, WorkingState& work, LocalResult& local);
  /// The objective is another one from here on.
  void forget() { accelerator().forget(); }
  /// q ← q + α p, not into a collider.
  void move(const LocalResult& local, const StepContext& context, WorkingState& work, StepReport& report);
  /// Of the time of the last move(), what its local steps took [s].
  double seconds_judging() const { return seconds_judging_; }
  /// Judges the last move, once it is known to be the last, and finds the residual where it led.
  void check_last_move(const StepContext& context, WorkingState& work, StepReport& report);

 private:
  /// What was found without pairs of surfaces, and whether the move has been refused by it.
  struct Judged {
    LocalResult local;
    bool is_refused = false;
  };
  static constexpr Index most_cuts = 5;
  static constexpr Real cut = 0.4;

  const Accelerator& accelerator() const;
  Accelerator& accelerator();
  LocalResult evaluate(const StepContext& context, WorkingState& work);
  LocalResult begin_lower(const LocalResult& local, const StepContext& context, WorkingState& work);
  bool must_go_back(const LocalResult& local) const;
  void go_back(Index cuts, const LocalResult& local, const StepContext& context, WorkingState& work);
  Real next_cut(const LocalResult& local) const;
  void solve(const LocalResult& local, const StepContext& context, WorkingState& work, StepReport& report);
  Real curvature(const StepContext& context, const WorkingState& work) const;
  bool must_factorize(const StepContext& context, WorkingState& work) const;
  static Real in_factor(const WorkingState& work);
  void factorize(const StepContext& context, WorkingState& work, StepReport& report);
  void move_plainly(const StepContext& context, WorkingState& work);
  void hold_back(const StepContext& context, WorkingState& work);
  bool judge_without_pairs(const StepContext& context, WorkingState& work);
  bool has_left_steep_place(const LocalResult& local) const;
  bool is_too_long(const StepContext& context, const WorkingState& work) const;

  Lbfgs lbfgs_;
  Anderson anderson_;
  Chebyshev chebyshev_;
  Acceleration chosen_ = Acceleration::lbfgs;
  RigidBalance balance_;
  bool is_accelerated_ = false;
  bool has_potentials_ = false;      // of elastic materials: the factor is no bound
  bool checks_plain_moves_ = false;  // for these and contact
  bool has_moved_ = false;           // and the objective is still the one that the move was made for
  bool was_cut_ = false;             // the move, so that no surface passes through another
  std::optional<Judged> judged_;     // where the last move led
  double seconds_judging_ = 0;
  bool is_first_ = true;            // of the moves of a substep
  bool have_pairs_pushed_ = false;  // in this substep
  Real steep_energy_ = 0;           // of pairs where the last move began [J]
};

}  // namespace pliant
