// The folder of a run, its run.json and, behind the first zero byte, its measurements.csv: an Error, or an animation
// whose bodies and frames fit each other.
#include <algorithm>
#include <cmath>
#include <string>

#include <unistd.h>

#include "fuzz.h"
#include "pliant/core/atomic_file.h"
#include "pliant/mesh/shapes.h"
#include "pliant/recorder/animation.h"
#include "pliant/recorder/run_files.h"

namespace {

using pliant_fuzz::require;

/// A folder with a mesh and two frames of it, which no input changes.
std::filesystem::path make_folder() {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("pliant_fuzz_run_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  pliant::Mesh mesh = pliant::chain({.links = 3});
  mesh.edges = {{0, 1}, {2, 3}};  // two bodies that share no element
  pliant::write_mesh(folder / "mesh.obj", mesh, mesh.vertices);
  for (const std::int64_t frame : {0, 1}) {
    pliant::write_mesh(folder / pliant::frame_file_name(frame, "obj"), mesh, mesh.vertices);
  }
  return folder;
}

void check(const pliant::Animation& animation) {
  require(!animation.times.empty(), "an animation without frames");
  for (std::size_t i = 0; i < animation.times.size(); ++i) {
    require(std::isfinite(animation.times[i]), "a time is not finite");
    require(i == 0 || animation.times[i] > animation.times[i - 1], "times do not rise");
    pliant::Positions positions;
    animation.cache.sample(animation.times[i], positions);
    require(positions.allFinite(), "a position is not finite");
  }
  pliant::Index next = 0;
  for (const pliant::Body& body : animation.bodies) {
    require(body.first_vertex == next, "bodies do not follow each other");
    next += body.mesh.vertex_count();
  }
  require(next == animation.cache.vertex_count(), "bodies and frames have other vertices");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path folder = make_folder();
  const std::string_view bytes = pliant_fuzz::text(data, size);
  const std::size_t end = std::min(bytes.find('\0'), size);
  pliant::write_file_atomically(folder / "run.json", bytes.substr(0, end));
  pliant::write_file_atomically(folder / "measurements.csv", bytes.substr(std::min(end + 1, size)));
  pliant_fuzz::expect_errors_only([&] { check(pliant::read_run(folder)); });
  return 0;
}
