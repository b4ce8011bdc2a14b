#pragma once
// A scene to the files of a run: what `pliant run` and `pliant resume` share.
#include <CLI/CLI.hpp>

#include "pliant_io/recorder/run_info.h"
#include "pliant_io/scene/scene.h"

namespace pliant_cli {

struct RecordingOptions {
  bool quiet = false;                 ///< print warnings and errors only
  std::int64_t checkpoint_every = 0;  ///< steps from checkpoint to checkpoint; 0: one at the end
};
void add_recording_options(CLI::App& command, RecordingOptions& options);

/// What run.json says of the scene.
pliant::RunInfo run_info(const pliant::Scene& scene, std::string source);

/// Simulates a scene to its last step, records it in a folder that is ready for it (begin_run or resume_run) and leaves
/// a checkpoint there. run.json says how it ended, whichever way that was. Returns the exit code.
int record_scene(pliant::Scene& scene, const std::filesystem::path& folder, pliant::RunInfo info,
                 const RecordingOptions& options);

}  // namespace pliant_cli
