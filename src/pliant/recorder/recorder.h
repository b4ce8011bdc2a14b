#pragma once
// The files of a run, in one folder: frames.npy or frame_*.obj, measurements.csv, run.json.
#include <memory>

#include "pliant/recorder/frame_writer.h"
#include "pliant/recorder/measurements.h"
#include "pliant/recorder/run_info.h"

namespace pliant {

/// Makes the folder where it is missing and removes the files that an earlier run left there; others stay.
/// @throws Error (output) when the name stands for something else, or the folder cannot be used.
void prepare_run_folder(const std::filesystem::path& folder);

/// Records a run. Whenever it is dropped, and whatever it throws, the frames and rows recorded before are whole.
class Recorder {
 public:
  /// Opens the files in a prepared folder. `frames` may be null. every ≥ 1: steps from record to record.
  /// @throws Error (output), as do all members.
  Recorder(std::filesystem::path folder, std::unique_ptr<FrameWriter> frames, std::int64_t every,
           const Simulation& simulation);

  /// Records the state if its step is a multiple of `every`; to be called at the start and after every step.
  void record(Simulation& simulation, const StepReport& report);

  /// Writes run.json; format, every and frames of `info` are filled in here.
  void finish(RunInfo info, const Simulation& simulation) const;

  std::int64_t frame_count() const { return frame_count_; }
  /// The residual of the last record [N].
  Real residual() const { return residual_; }

 private:
  std::filesystem::path folder_;
  std::unique_ptr<FrameWriter> frames_;
  MeasurementsWriter measurements_;
  std::int64_t every_;
  std::int64_t frame_count_ = 0;
  Real residual_ = 0;
};

}  // namespace pliant
