#include "recording.h"

#include <algorithm>

#include <pybind11/stl/filesystem.h>

#include "pliant_io/recorder/run_files.h"
#include "pliant_io/scene/scene_source.h"

namespace pliant_python {
namespace {

using pliant::Outcome;
using pliant::RunInfo;
using pliant::Simulation;

Outcome outcome_of(const std::exception& error) {
  if (const auto* raised = dynamic_cast<const py::error_already_set*>(&error)) {
    const py::gil_scoped_acquire lock;
    return raised->matches(PyExc_KeyboardInterrupt) ? Outcome::interrupted : Outcome::failed;
  }
  const auto* known = dynamic_cast<const pliant::Error*>(&error);
  if (known == nullptr) return Outcome::failed;
  if (known->kind() == pliant::ErrorKind::diverged) return Outcome::diverged;
  return known->kind() == pliant::ErrorKind::interrupted ? Outcome::interrupted : Outcome::failed;
}

/// A simulation of one's own, that Python holds, and its recording.
struct OwnRun {
  std::shared_ptr<Handle> handle;
  Recording recording;

  pliant::StepReport step() {
    if (recording.has_ended()) pliant::fail_input("record: this run has ended; begin another one with record()");
    return handle->run([&](Simulation& simulation) {
      try {
        const pliant::StepReport report = simulation.step();
        recording.record(simulation, report);
        return report;
      } catch (const std::exception& error) {
        recording.end(simulation, error);
        throw;
      }
    });
  }
};

/// To be called before the folder is made.
void check(const Handle& handle, const std::string& format, std::int64_t every) {
  const auto formats = choice_names(pliant::FrameFormat{});
  if (std::ranges::find(formats, format) == formats.end()) {
    pliant::fail_input("record: format: '" + format + "'; give npy, pc2, obj, ply or none");
  }
  if (every < 1) pliant::fail_input("record: every: " + std::to_string(every) + " is out of range; give 1 or more");
  if (handle.idle().bodies().empty()) pliant::fail_input("record: the simulation has no body; add one first");
}

std::unique_ptr<OwnRun> begin(const std::shared_ptr<Handle>& handle, const std::filesystem::path& folder,
                              const std::string& format, std::int64_t every, const std::string& name) {
  RunInfo info;
  info.scene = name;
  info.source = "Python";
  info.every = every;
  info.frame_format = format;
  return handle->run([&](Simulation& simulation) {
    std::vector<std::string> colliders;
    for (const auto& [id, record] : simulation.colliders()) colliders.push_back(simulation.name(id));
    return std::make_unique<OwnRun>(OwnRun{handle, Recording(folder, info, simulation, simulation.group_names(),
                                                             {colliders, simulation.contact().surfaces})});
  });
}

}  // namespace

Recording::Recording(std::filesystem::path folder, RunInfo info, Simulation& simulation,
                     const std::vector<std::string>& groups, const pliant::ContactColumns& contact)
    : folder_(std::move(folder)), info_(std::move(info)) {
  pliant::make_run_folder(folder_);
  pliant::begin_run(folder_, info_, simulation);
  try {
    recorder_.emplace(folder_, make_frame_writer(info_.frame_format, folder_, simulation), info_.every, groups, 0,
                      contact);
    recorder_->record(simulation, {});
  } catch (const std::exception& error) {
    end(simulation, error);
    throw;
  }
}

void Recording::end(const Simulation& simulation, Outcome outcome, const std::string& message) {
  if (has_ended_) return;
  has_ended_ = true;
  info_.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  if (recorder_) {
    info_.frames = recorder_->frame_count();
    info_.last_frame = recorder_->last_frame_checksum();
    recorder_.reset();
  }
  info_.wanted_steps = std::max(info_.wanted_steps, simulation.state().step);
  info_.outcome = outcome;
  info_.error = message;
  pliant::end_run(folder_, info_, simulation);
}

void Recording::end(const Simulation& simulation, const std::exception& error,
                    const std::function<void()>& save) noexcept {
  const Outcome outcome = outcome_of(error);
  try {
    if (save && outcome != Outcome::failed) save();
  } catch (const std::exception&) {  // the first error is the one to tell
  }
  try {
    end(simulation, outcome, outcome == Outcome::interrupted ? "" : error.what());
  } catch (const std::exception&) {  // it may meet the same full disk
  }
}

void bind_recordings(py::module_& module) {
  py::class_<OwnRun>(module, "Recording")
      .def(py::init(&begin))
      .def_static("check", &check)
      .def("step", [](OwnRun& run) { return report_of(run.step()); })
      .def("end", [](OwnRun& run, const std::string& outcome, const std::string& message) {
        const auto names = choice_names(Outcome{});
        const auto found = std::ranges::find(names, outcome);
        run.recording.end(run.handle->idle(), static_cast<Outcome>(found - names.begin()), message);
      });
}

}  // namespace pliant_python
