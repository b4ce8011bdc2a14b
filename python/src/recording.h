#pragma once
// A run of a simulation to files, as `pliant run` leaves it.
#include <chrono>
#include <functional>
#include <memory>
#include <optional>

#include "bindings.h"
#include "pliant_io/recorder/recorder.h"

namespace pliant_python {

class Recording {
 public:
  /// Makes the folder ready and records the state at hand. `info` says of what, in which format and how often.
  /// @throws pliant::Error (output), as do all members
  Recording(std::filesystem::path folder, pliant::RunInfo info, pliant::Simulation& simulation,
            const std::vector<std::string>& groups, const pliant::ContactColumns& contact);

  /// Records the state after a step, if it is its turn.
  void record(pliant::Simulation& simulation, const pliant::StepReport& report) {
    recorder_->record(simulation, report);
  }
  bool has_ended() const { return has_ended_; }
  /// Writes how it ended, and closes the files; the first call counts.
  void end(const pliant::Simulation& simulation, pliant::Outcome outcome, const std::string& message = {});
  /// After an error, which is the one to tell. Before, unless a file could not be written, save() is called.
  void end(const pliant::Simulation& simulation, const std::exception& error,
           const std::function<void()>& save = {}) noexcept;

 private:
  std::filesystem::path folder_;
  pliant::RunInfo info_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::optional<pliant::Recorder> recorder_;  // none where it could not be made
  bool has_ended_ = false;
};

}  // namespace pliant_python
