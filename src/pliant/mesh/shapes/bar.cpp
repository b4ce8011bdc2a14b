#include "pliant/mesh/shapes/bar.h"

#include "pliant/mesh/shapes/limits.h"

namespace pliant {

namespace {

/// Corner n of a cell lies at (n & 1, n >> 1 & 1, n >> 2) from its first vertex. Kuhn's six paths from corner 0 to
/// corner 7, one axis at a time; the two middle corners are swapped in odd ones, so that every volume is positive.
constexpr std::array<std::array<unsigned, 4>, 6> six_cut{
    {{0, 1, 3, 7}, {0, 5, 1, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 6, 4, 7}}};

/// The middle tetrahedron has the corners of even parity; the others cut off one odd corner each.
constexpr std::array<std::array<unsigned, 4>, 5> five_cut{
    {{0, 5, 3, 6}, {1, 3, 0, 5}, {2, 0, 3, 6}, {4, 0, 6, 5}, {7, 3, 5, 6}}};

/// Appends the tetrahedra of one cell, given the mesh's vertex at each of its corners.
void cut_cell(TetrahedronCut cut, bool is_even, const std::array<Index, 8>& corners,
              std::vector<Tetrahedron>& tetrahedra) {
  if (cut == TetrahedronCut::six) {
    for (const auto& [a, b, c, d] : six_cut) tetrahedra.push_back({corners[a], corners[b], corners[c], corners[d]});
    return;
  }
  for (const auto& [a, b, c, d] : five_cut) {
    if (is_even) {
      tetrahedra.push_back({corners[a], corners[b], corners[c], corners[d]});
    } else {  // mirrored in x, which turns the tetrahedra inside out: hence d before c
      tetrahedra.push_back({corners[a ^ 1U], corners[b ^ 1U], corners[d ^ 1U], corners[c ^ 1U]});
    }
  }
}

}  // namespace

Mesh bar(const BarOptions& options) {
  check_options(options.shape, options);
  const auto& [nx, ny, nz] = options.cells;
  require_vertex_count("bar: cells", (nx + Real{1}) * (ny + Real{1}) * (nz + Real{1}));

  Mesh mesh;
  mesh.vertices.resize((nx + 1) * (ny + 1) * (nz + 1), 3);
  const auto vertex = [nx = nx, ny = ny](Index i, Index j, Index k) { return (k * (ny + 1) + j) * (nx + 1) + i; };
  for (Index k = 0; k <= nz; ++k) {
    for (Index j = 0; j <= ny; ++j) {
      for (Index i = 0; i <= nx; ++i) {
        mesh.vertices.row(vertex(i, j, k)) << options.size[0] * i / nx, options.size[1] * j / ny,
            options.size[2] * k / nz;
        if (i == nx || j == ny || k == nz) continue;
        std::array<Index, 8> corners{};
        for (Index n = 0; n < 8; ++n) {
          corners[static_cast<std::size_t>(n)] = vertex(i + n % 2, j + n / 2 % 2, k + n / 4);
        }
        cut_cell(options.cut, (i + j + k) % 2 == 0, corners, mesh.tetrahedra);
      }
    }
  }
  return mesh;
}

}  // namespace pliant
