#pragma once
// The files of a run, in one folder; run_files.h has their names.
#include <memory>
#include <optional>

#include "pliant_io/recorder/frame_writer.h"
#include "pliant_io/recorder/measurements.h"
#include "pliant_io/recorder/run_info.h"

namespace pliant {

/// Makes the folder ready for a run (prepare_run_folder in run_files.h) and writes what stands there from its start on:
/// run.json, which says that it is running and so tells whose the other files are, and mesh.obj, the bodies as objects
/// at their positions of now, which the frames move. `info` gives the format of the frames.
/// @throws Error (output)
void begin_run(const std::filesystem::path& folder, RunInfo info, const Simulation& simulation);

/// Writes run.json of a run that goes on where one has stopped: it is running again; removes what a killed one left
/// half-written (remove_leftovers). @throws Error (output)
void resume_run(const std::filesystem::path& folder, RunInfo info, const Simulation& simulation);

/// Writes run.json anew, with how the run ended. @throws Error (output)
void end_run(const std::filesystem::path& folder, const RunInfo& info, const Simulation& simulation);

/// Records a run. Whenever it is dropped, and whatever it throws, the frames and rows recorded before are whole.
class Recorder {
 public:
  /// Opens the files in a prepared folder. `frames` may be null. every ≥ 1: steps from record to record. `groups` have
  /// columns in measurements.csv, and so has `contact`; a group that comes later may be among them. kept: records of an
  /// earlier run that stay, for one that goes on.
  /// @throws Error (output), as do all members; Error (input) when those records are not there.
  Recorder(std::filesystem::path folder, std::unique_ptr<FrameWriter> frames, std::int64_t every,
           const std::vector<std::string>& groups, std::int64_t kept = 0, const ContactColumns& contact = {});

  /// Records the state if its step is a multiple of `every`; to be called at the start and after every step.
  void record(Simulation& simulation, const StepReport& report);

  std::int64_t frame_count() const { return frame_count_; }
  /// Of the last frame that was recorded here; none before the first.
  std::optional<std::uint32_t> last_frame_checksum() const;
  /// The residual of the last record [N].
  Real residual() const { return residual_; }

 private:
  std::filesystem::path folder_;
  std::unique_ptr<FrameWriter> frames_;
  MeasurementsWriter measurements_;
  std::int64_t every_;
  std::int64_t frame_count_ = 0;
  Positions last_frame_;
  Real residual_ = 0;
};

}  // namespace pliant
