// The folder of a run, its run.json and, behind the first zero byte, its measurements.csv: an Error, or an animation
// whose bodies and frames fit each other.
#include <algorithm>
#include <cmath>
#include <string>
#include <system_error>

#include <unistd.h>

#include "fuzz.h"
#include "pliant/mesh/shapes.h"
#include "pliant_io/export/animation.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/recorder/run_files.h"

namespace {

using pliant_fuzz::require;

/// A folder with a mesh and two frames of it, which no input changes; it goes when the program ends.
struct RunFolder {
  std::filesystem::path path = std::filesystem::temp_directory_path() / ("pliant_fuzz_run_" + std::to_string(getpid()));

  RunFolder() {
    std::filesystem::create_directories(path);
    pliant::Mesh mesh = pliant::chain({.links = 3});
    mesh.edges = {{0, 1}, {2, 3}};  // two bodies that share no element
    pliant::write_mesh(path / "mesh.obj", mesh, mesh.vertices);
    for (const std::int64_t frame : {0, 1}) {
      pliant::write_mesh(path / pliant::frame_file_name(frame, "obj"), mesh, mesh.vertices);
    }
  }
  ~RunFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
};

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
  static const RunFolder folder;
  const std::string_view bytes = pliant_fuzz::text(data, size);
  const std::size_t end = std::min(bytes.find('\0'), size);
  pliant::write_file_atomically(folder.path / "run.json", bytes.substr(0, end));
  pliant::write_file_atomically(folder.path / "measurements.csv", bytes.substr(std::min(end + 1, size)));
  pliant_fuzz::expect_errors_only([&] { check(pliant::read_run(folder.path)); });
  return 0;
}
