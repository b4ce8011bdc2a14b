// Reading a million-triangle OBJ: time against tinyobjloader's (where it is installed) in turns, and memory a vertex;
// and the same mesh in the other formats.
//
//     bench_mesh_files [repeats]
//
// Memory is the peak resident set of a process of its own that reads the file once, less that of one that reads
// nothing. The reader never maps the file, so that no page of it is hidden in the page cache's account.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "pliant/core/stopwatch.h"
#include "pliant/mesh/shapes.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/mesh/mesh_file.h"
#include "system/memory.h"
#include "system/temporary_folder.h"
#ifdef PLIANT_HAS_TINYOBJLOADER
#include <tiny_obj_loader.h>
#endif

namespace {

namespace fs = std::filesystem;
using namespace pliant;
using pliant_system::peak_memory_bytes_of;

constexpr Index side = 708;

/// A wavy sheet, its coordinates with so many digits behind the point.
void write_sheet(const fs::path& path, const Mesh& sheet, int digits, bool has_texture) {
  std::string text;
  for (Index v = 0; v < sheet.vertex_count(); ++v) {
    const Vec3 x = row(sheet.vertices, v);
    text += fmt::format("v {:.{}f} {:.{}f} {:.{}f}\n", x[0], digits, 0.05 * std::sin(9 * x[0] + 7 * x[2]), digits, x[2],
                        digits);
  }
  for (Index v = 0; v < sheet.vertex_count() && has_texture; ++v) {
    text += fmt::format("vt {:.6f} {:.6f}\n", sheet.vertices(v, 0), sheet.vertices(v, 2));
  }
  for (const Triangle& triangle : sheet.triangles) {
    text += 'f';
    for (const Index vertex : triangle) {
      text += has_texture ? fmt::format(" {0}/{0}", vertex + 1) : fmt::format(" {}", vertex + 1);
    }
    text += '\n';
  }
  write_file_atomically(path, text);
}

double median(std::vector<double> seconds) {
  std::ranges::sort(seconds);
  return seconds[seconds.size() / 2];
}

double seconds_of(const std::function<void()>& act) {
  const Stopwatch watch;
  act();
  return watch.seconds();
}

void read_with_tinyobjloader([[maybe_unused]] const std::string& path) {
#ifdef PLIANT_HAS_TINYOBJLOADER
  tinyobj::ObjReader reader;
  reader.ParseFromFile(path);
#endif
}

/// Bytes a vertex beyond those of a process that reads nothing.
double memory_of_reading(const fs::path& path, Index vertices) {
  const std::int64_t memory = peak_memory_bytes_of([&] { read_mesh(path); }) - peak_memory_bytes_of([] {});
  return static_cast<double>(memory) / vertices;
}

void time_reading(const fs::path& path, int repeats, double memory) {
  const bool is_obj = path.extension() == ".obj";
  std::vector<double> ours, theirs;
  for (int i = 0; i < repeats; ++i) {
    ours.push_back(seconds_of([&] { read_mesh(path); }));
    if (is_obj) theirs.push_back(seconds_of([&] { read_with_tinyobjloader(path.string()); }));
  }
  const auto megabytes = static_cast<double>(fs::file_size(path)) * 1e-6;
  fmt::print("{:16} {:8.1f} {:10.3f} {:10.0f}", path.filename().string(), megabytes, median(ours), memory);
#ifdef PLIANT_HAS_TINYOBJLOADER
  if (is_obj) fmt::print(" {:10.3f} {:8.2f}", median(theirs), median(ours) / median(theirs));
#endif
  fmt::print("\n");
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::max(1, std::atoi(argv[1])) : 7;
  const pliant_system::TemporaryFolder temporary("pliant-bench");
  const fs::path& folder = temporary.path();
  const std::vector<fs::path> files = {folder / "digits6.obj", folder / "digits9.obj", folder / "texture.obj",
                                       folder / "sheet.ply",   folder / "sheet.off",   folder / "sheet.stl"};
  peak_memory_bytes_of([&] {  // in a child, which takes its memory with it
    const Mesh sheet = grid({.columns = side, .rows = side});
    write_sheet(files[0], sheet, 6, false);
    write_sheet(files[1], sheet, 9, false);
    write_sheet(files[2], sheet, 9, true);
    const Mesh mesh = read_mesh(files[1]);
    for (std::size_t f = 3; f < files.size(); ++f) write_mesh(files[f], mesh, mesh.vertices);
  });
  fmt::print("{:16} {:>8} {:>10} {:>10} {:>10} {:>8}\n", "", "MB", "s", "B/vertex", "tinyobj s", "ratio");
  // Before anything is read here: a child starts with its parent's memory.
  std::vector<double> memory;
  for (const fs::path& file : files) memory.push_back(memory_of_reading(file, side * side));
  for (std::size_t f = 0; f < files.size(); ++f) time_reading(files[f], repeats, memory[f]);
  return 0;
}
