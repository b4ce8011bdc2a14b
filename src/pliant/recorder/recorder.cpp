#include "pliant/recorder/recorder.h"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "pliant/core/error.h"

namespace pliant {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail_output(const fs::path& path, const std::error_code& error) {
  throw Error(ErrorKind::output, fmt::format("{}: cannot be used for the files of a run: {}; choose another folder",
                                             path.string(), error.message()));
}

/// frame_00000.obj and so on.
bool is_obj_frame(std::string_view name) {
  constexpr std::string_view head = "frame_";
  constexpr std::string_view tail = ".obj";
  if (!name.starts_with(head) || !name.ends_with(tail) || name.size() < head.size() + 5 + tail.size()) return false;
  const std::string_view digits = name.substr(head.size(), name.size() - head.size() - tail.size());
  return digits.find_first_not_of("0123456789") == digits.npos;
}

bool is_run_file(std::string_view name) {
  return name == "frames.npy" || name == "measurements.csv" || name == "run.json" || is_obj_frame(name);
}

}  // namespace

void prepare_run_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail_output(folder, error);
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (!is_run_file(entry->path().filename().string()) || !entry->is_regular_file(error)) continue;
    fs::remove(entry->path(), error);
    if (error) fail_output(entry->path(), error);
  }
  if (error) fail_output(folder, error);
}

Recorder::Recorder(fs::path folder, std::unique_ptr<FrameWriter> frames, std::int64_t every,
                   const Simulation& simulation)
    : folder_(std::move(folder)),
      frames_(std::move(frames)),
      measurements_(folder_ / "measurements.csv", simulation),
      every_(every) {
  if (every < 1) fail_input(fmt::format("records every {} steps are not possible; give a number from 1 up", every));
}

void Recorder::record(Simulation& simulation, const StepReport& report) {
  if (simulation.state().step % every_ != 0) return;
  const Measurements row = measure(simulation, report);
  if (frames_) {
    frames_->add(simulation.state().positions);
    ++frame_count_;
  }
  measurements_.add(row);
  residual_ = row.residual;
}

void Recorder::finish(RunInfo info, const Simulation& simulation) const {
  info.frame_format = frames_ ? frames_->format() : "none";
  info.every = every_;
  info.frames = frame_count_;
  write_run_info(folder_ / "run.json", info, simulation);
}

}  // namespace pliant
