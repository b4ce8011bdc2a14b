#pragma once
// A simulation as Python holds it: arrays that look at its state and never dangle, Python's lock, Ctrl-C.
#include <atomic>
#include <chrono>
#include <memory>

#include "convert.h"

namespace pliant_python {

/// What an array that looks at the state keeps alive: the simulation, or, once the simulation has taken other memory
/// for its state, the memory that it had until then.
struct StateMemory {
  std::shared_ptr<pliant::Simulation> simulation;
  pliant::Positions kept;
};

class Handle {
 public:
  explicit Handle(std::shared_ptr<pliant::Simulation> simulation);
  ~Handle();
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  /// The simulation between two steps. Throws Error(input) while a step is under way, on whatever thread.
  pliant::Simulation& idle() const;
  /// At any time, to look at what a step does not change before its end.
  const pliant::Simulation& now() const { return *simulation_; }

  /// Calls f without Python's lock, and nobody else may change the simulation until it is done. Ctrl-C ends a step that
  /// is under way, as KeyboardInterrupt.
  template <class F>
  auto run(F&& f) {
    idle();
    const Busy busy(is_busy_);
    try {
      const py::gil_scoped_release release;
      return f(*simulation_);
    } catch (const pliant::Error& error) {
      if (error.kind() != pliant::ErrorKind::interrupted || PyErr_Occurred() == nullptr) throw;
    }
    throw py::error_already_set();
  }

  /// Read-only arrays, m x 3, that look at the state: they follow it from step to step.
  py::array positions() { return view(now().state().positions, positions_); }
  py::array velocities() { return view(now().state().velocities, velocities_); }
  /// To be called before the state may take other memory: arrays keep what they see from then on.
  void let_go_of_arrays();

 private:
  struct Busy {
    explicit Busy(std::atomic<bool>& flag) : flag_(flag) { flag_ = true; }
    ~Busy() { flag_ = false; }
    Busy(const Busy&) = delete;
    Busy& operator=(const Busy&) = delete;
    std::atomic<bool>& flag_;
  };

  py::array view(const pliant::Positions& rows, std::weak_ptr<StateMemory>& memory) const;
  static void let_go(const pliant::Positions& rows, std::weak_ptr<StateMemory>& memory);
  bool has_signal();

  std::shared_ptr<pliant::Simulation> simulation_;
  std::weak_ptr<StateMemory> positions_;
  std::weak_ptr<StateMemory> velocities_;
  std::atomic<bool> is_busy_{false};
  std::chrono::steady_clock::time_point asked_{};
};

}  // namespace pliant_python
