#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/mesh/geometry.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/mesh/detail/mesh_output.h"
#include "pliant_io/mesh/stl.h"

namespace pliant {

namespace {

static_assert(std::endian::native == std::endian::little, "STL has its bytes in this order");

template <typename Number>
void add(TextOutput& out, Number number) {
  out << std::string_view(reinterpret_cast<const char*>(&number), sizeof number);
}

/// @throws Error (input) where single precision has no number for it.
float rounded(Real x, const std::filesystem::path& path, Index vertex) {
  if (std::abs(x) <= Real{std::numeric_limits<float>::max()}) return static_cast<float>(x);
  fail_input(
      fmt::format("{}: the position of vertex {} is past what STL holds, 3.4e38 m; write PLY", path.string(), vertex));
}

}  // namespace

void write_stl(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions) {
  check_positions(path, mesh, positions);
  const std::vector<Triangle> triangles = visible_triangles(mesh);
  if (triangles.empty()) {
    fail_input(
        fmt::format("{}: the mesh has no triangles, and STL holds nothing else; write OBJ or PLY", path.string()));
  }
  AtomicFile file(path);
  TextOutput out(file);
  std::string header = "Pliant";  // anything but "solid", which begins a text
  header.resize(80);
  out << header;
  add(out, static_cast<std::uint32_t>(triangles.size()));
  const Positions normals = triangle_normals(positions, triangles);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (Eigen::Index k = 0; k < 3; ++k) add(out, static_cast<float>(normals(static_cast<Eigen::Index>(t), k)));
    for (const Index vertex : triangles[t]) {
      for (Eigen::Index k = 0; k < 3; ++k) add(out, rounded(positions(vertex, k), path, vertex));
    }
    add(out, std::uint16_t{0});
    out.flush_when_full();
  }
  out.flush();
  file.commit();
}

}  // namespace pliant
