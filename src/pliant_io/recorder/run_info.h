#pragma once
// run.json: what was run, with what, and how it ended.
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "pliant/simulation/simulation.h"

namespace pliant {

/// How a run ended; running: it has not yet, or it was killed.
enum class Outcome { ok, diverged, interrupted, failed, running };
constexpr std::array<std::string_view, 5> choice_names(Outcome) {
  return {"ok", "diverged", "interrupted", "failed", "running"};
}

/// Steps whose iterations ended before a tolerance that was asked for was reached.
struct MissedTolerance {
  std::int64_t steps = 0;
  double worst_residual = 0;  ///< largest force left on a vertex in any of them [N], before its last iteration
};

/// How far the iterations left a step from its end (StepError), of the steps that were looked at the worst.
struct WorstStep {
  std::int64_t step = 0;
  std::string body;
  double distance = 0;  ///< [m]
  double share = 0;
};

/// What the simulation does not know about its run.
struct RunInfo {
  std::string scene;         ///< its name
  std::string source;        ///< the file or the built-in scene it was read from
  std::string frame_format;  ///< "none" when no frames were written
  std::int64_t every = 1;    ///< steps from record to record
  std::int64_t wanted_steps = 0;
  std::int64_t frames = 0;
  std::optional<std::int64_t> resumed_from;  ///< step at which this run went on
  std::optional<std::uint32_t> last_frame;   ///< its checksum (frame_checksum); none: no frame was recorded
  double wall_seconds = 0;
  MissedTolerance missed_tolerance;  ///< since the start of the run, or since it was resumed
  /// Of those that count, see docs/algorithm.md, since the start or since it was resumed.
  std::optional<WorstStep> worst_step;
  Outcome outcome = Outcome::running;
  std::string error;  ///< the message when it did not end well
};

/// The CRC-32 of positions rounded to float32, which all formats of frames hold alike.
std::uint32_t frame_checksum(const Positions& positions);

/// Calls field(key, value) with what run.json and `pliant check` tell of a group.
template <class Field>
void describe_group(const Simulation& simulation, const Group& group, Field&& field) {
  field("name", group.name);
  field("type", group.type);
  field("body", simulation.body(group.body).name);
  if (group.other) field("other", simulation.body(*group.other).name);
  field("constraints", group.set.count);
  field("skipped", group.set.skipped);
}

/// Constraints of each type, whatever their groups.
std::map<std::string, std::int64_t> count_constraints(const Simulation& simulation);

/// Writes the file, whole or not at all. @throws Error (output)
void write_run_info(const std::filesystem::path& path, const RunInfo& info, const Simulation& simulation);

}  // namespace pliant
