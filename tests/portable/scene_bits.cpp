// Runs built-in scenes and leaves their positions, so that two builds of the library can be compared bit by bit:
//     scene_bits FOLDER [STEPS [VERTICES [SCENE...]]]
// takes STEPS (60) of every scene of up to VERTICES (3000), or of those named, on one thread with Eigen's
// factorization. FOLDER gets a file SCENE.bits of 64-bit numbers, the positions after the first step and after the
// last; a line of the output is a scene, its vertices, steps, the CRC-32 of the last positions and milliseconds a step.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "pliant/core/stopwatch.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/files/crc32.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "pliant_io/scene/scene.h"

namespace {

using namespace pliant;

std::string bytes_of(const Positions& positions) {
  const auto size = static_cast<std::size_t>(positions.size()) * sizeof(Real);
  return {reinterpret_cast<const char*>(positions.data()), size};  // NOLINT: as bytes
}

void run(const BuiltinScene& builtin, std::int64_t steps, Eigen::Index most_vertices,
         const std::filesystem::path& folder) {
  SceneOverrides overrides;
  overrides.threads = 1;
  overrides.backend = Backend::eigen;
  Scene scene = parse_scene(builtin.text, "", builtin.name, overrides);
  const State& state = scene.simulation.state();
  const Eigen::Index vertices = state.positions.rows();
  if (vertices > most_vertices) return;
  scene.step();
  std::string bits = bytes_of(state.positions);
  std::vector<double> seconds;
  for (std::int64_t i = 1; i < steps; ++i) {
    const Stopwatch watch;
    scene.step();
    seconds.push_back(watch.seconds());
  }
  const auto middle = seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2);
  std::nth_element(seconds.begin(), middle, seconds.end());
  const std::string last = bytes_of(state.positions);
  write_file_atomically(folder / fmt::format("{}.bits", builtin.name), bits + last);
  fmt::print("{} {} {} {:08x} {:.3f}\n", builtin.name, vertices, steps, crc32(last), 1000 * *middle);
  std::fflush(stdout);
}

int run_all(const std::vector<std::string>& words) {
  if (words.empty()) {
    fmt::print(stderr, "scene_bits FOLDER [STEPS [VERTICES [SCENE...]]]\n");
    return 2;
  }
  const std::int64_t steps = words.size() > 1 ? std::stoll(words[1]) : 60;
  const Eigen::Index most_vertices = words.size() > 2 ? std::stoi(words[2]) : 3000;
  if (steps < 2) {
    fmt::print(stderr, "scene_bits: {} steps; take 2 or more\n", steps);
    return 2;
  }
  std::filesystem::create_directories(words[0]);
  for (const BuiltinScene& builtin : builtin_scenes()) {
    bool is_wanted = words.size() <= 3;
    for (std::size_t i = 3; i < words.size(); ++i) is_wanted = is_wanted || words[i] == builtin.name;
    if (is_wanted) run(builtin, steps, most_vertices, words[0]);
  }
  return 0;
}

}  // namespace

int main(int count, char** words) {
  try {
    return run_all(std::vector<std::string>(words + 1, words + count));
  } catch (const std::exception& error) {
    fmt::print(stderr, "scene_bits: {}\n", error.what());
    return 1;
  }
}
