#include "pliant_io/recorder/recorder.h"

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/mesh/mesh_file.h"
#include "pliant_io/recorder/detail/one_mesh.h"
#include "pliant_io/recorder/run_files.h"

namespace pliant {

namespace fs = std::filesystem;

void begin_run(const fs::path& folder, RunInfo info, const Simulation& simulation) {
  prepare_run_folder(folder, info.frame_format);
  info.outcome = Outcome::running;
  write_run_info(folder / "run.json", info, simulation);
  if (info.frame_format == "none") return;
  write_mesh(folder / "mesh.obj", one_mesh_of_run(simulation.bodies()), simulation.state().positions);
}

void end_run(const fs::path& folder, const RunInfo& info, const Simulation& simulation) {
  write_run_info(folder / "run.json", info, simulation);
}

void resume_run(const fs::path& folder, RunInfo info, const Simulation& simulation) {
  remove_leftovers(folder, is_run_file);
  info.outcome = Outcome::running;
  write_run_info(folder / "run.json", info, simulation);
}

Recorder::Recorder(fs::path folder, std::unique_ptr<FrameWriter> frames, std::int64_t every,
                   const std::vector<std::string>& groups, std::int64_t kept, const ContactColumns& contact)
    : folder_(std::move(folder)),
      frames_(std::move(frames)),
      measurements_(folder_ / "measurements.csv", groups, kept, contact),
      every_(every),
      frame_count_(frames_ ? kept : 0) {
  if (every < 1) fail_input(fmt::format("records every {} steps are not possible; give a number from 1 up", every));
}

void Recorder::record(Simulation& simulation, const StepReport& report) {
  if (simulation.state().step % every_ != 0) return;
  const Measurements row = measure(simulation, report);
  if (frames_) {
    frames_->add(simulation.state().positions);
    ++frame_count_;
    last_frame_ = simulation.state().positions;
  }
  measurements_.add(row);
  residual_ = row.residual;
}

std::optional<std::uint32_t> Recorder::last_frame_checksum() const {
  return last_frame_.rows() > 0 ? std::optional(frame_checksum(last_frame_)) : std::nullopt;
}

}  // namespace pliant
