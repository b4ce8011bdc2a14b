#pragma once
// What run.json and measurements.csv tell of a run that has been.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pliant/core/types.h"

namespace pliant {

/// A body as run.json has it: the part of the vertices that is its own.
struct BodyRange {
  std::string name;
  Index first_vertex = 0;
  Index vertex_count = 0;
};

struct EarlierRun {
  std::string scene;
  std::string format;                       ///< of the frames, or "none"
  std::vector<std::string> files;           ///< as run_files() names them
  std::optional<std::int64_t> frame_count;  ///< none for a run that could not tell how it ended
  std::optional<std::uint32_t> last_frame;  ///< frame_checksum(); none for such a run and those of version 0.1.0
  Real seconds_per_frame = 0;               ///< by the settings at its end
  std::vector<BodyRange> bodies;            ///< they follow each other, from vertex 0
};

/// @throws Error (input) `file: place: what`: not readable, or not what a run writes.
EarlierRun read_earlier_run(const std::filesystem::path& path);

/// The column "time" of measurements.csv [s], one for each frame; empty where there is no such file.
/// @throws Error (input) `file:line: what`: a line without a finite time that is after the one before.
std::vector<Real> read_frame_times(const std::filesystem::path& path);

}  // namespace pliant
