#include "handle.h"

namespace pliant_python {

Handle::Handle(std::shared_ptr<pliant::Simulation> simulation) : simulation_(std::move(simulation)) {
  simulation_->set_stop([this] { return has_signal(); });
}

Handle::~Handle() {
  simulation_->set_stop({});  // arrays may keep it
}

pliant::Simulation& Handle::idle() const {
  if (is_busy_) pliant::fail_input("the simulation is in the middle of a step; wait until that is done");
  return *simulation_;
}

/// Asked before each iteration; seldom, since Python's lock may be another thread's for some milliseconds.
bool Handle::has_signal() {
  const auto now = std::chrono::steady_clock::now();
  if (now - asked_ < std::chrono::milliseconds(50)) return false;
  asked_ = now;
  const py::gil_scoped_acquire lock;
  return PyErr_CheckSignals() != 0;
}

py::array Handle::view(const pliant::Positions& rows, std::weak_ptr<StateMemory>& memory) const {
  std::shared_ptr<StateMemory> owner = memory.lock();
  if (owner == nullptr) {
    owner = std::make_shared<StateMemory>(StateMemory{simulation_, {}});
    memory = owner;
  }
  const py::capsule base(new std::shared_ptr<StateMemory>(owner),
                         [](void* held) { delete static_cast<std::shared_ptr<StateMemory>*>(held); });
  py::array_t<double> array({rows.rows(), py::ssize_t{3}}, rows.data(), base);
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// The state gets a copy, and the arrays its memory. The simulation was not made const, and is the same as before.
void Handle::let_go(const pliant::Positions& rows, std::weak_ptr<StateMemory>& memory) {
  const std::shared_ptr<StateMemory> owner = memory.lock();
  if (owner == nullptr) return;
  owner->kept = rows;
  owner->kept.swap(const_cast<pliant::Positions&>(rows));
  owner->simulation.reset();
  memory.reset();
}

void Handle::let_go_of_arrays() {
  let_go(idle().state().positions, positions_);
  let_go(idle().state().velocities, velocities_);
}

}  // namespace pliant_python
