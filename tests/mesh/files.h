#pragma once
// Meshes from texts, what a refused one says, and whether two meshes are the same.
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "pliant_io/mesh/mesh_file.h"
#include "tests/mesh/meshes.h"
#include "tests/support/temporary_folder.h"

namespace pliant_tests {

/// The message for a text that is refused, the mesh being called `a`.
inline std::string refusal_of(const std::string& text, const pliant::MeshFormat& format) {
  return error_of([&] { pliant::parse_mesh(text, "a", format); });
}

/// Read from a file, which is the way of large ones, and from memory; both the same.
inline pliant::Mesh written_and_read(const pliant::Mesh& mesh, const std::string& name) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / name;
  pliant::write_mesh(file, mesh, mesh.vertices);
  CHECK(folder.file_count() == 1);
  return pliant::read_mesh(file);
}

inline void check_same_numbers(const pliant::Real* a, const pliant::Real* b, Eigen::Index count) {
  for (Eigen::Index i = 0; i < count; ++i) {
    if (a[i] == b[i] && std::signbit(a[i]) == std::signbit(b[i])) continue;
    CAPTURE(i);
    CHECK(a[i] == b[i]);
    CHECK(std::signbit(a[i]) == std::signbit(b[i]));
  }
}

inline void check_same_elements(const pliant::Mesh& a, const pliant::Mesh& b) {
  REQUIRE(a.vertices.rows() == b.vertices.rows());
  check_same_numbers(a.vertices.data(), b.vertices.data(), a.vertices.size());
  CHECK(a.edges == b.edges);
  CHECK(a.triangles == b.triangles);
  CHECK(a.tetrahedra == b.tetrahedra);
}

/// To the bit, and in the same order.
inline void check_same(const pliant::Mesh& a, const pliant::Mesh& b) {
  check_same_elements(a, b);
  CHECK(a.faces.offsets == b.faces.offsets);
  CHECK(a.faces.vertices == b.faces.vertices);
  CHECK(a.faces.texture_coordinates == b.faces.texture_coordinates);
  REQUIRE(a.texture_coordinates.rows() == b.texture_coordinates.rows());
  check_same_numbers(a.texture_coordinates.data(), b.texture_coordinates.data(), a.texture_coordinates.size());
  REQUIRE(a.groups.size() == b.groups.size());
  for (std::size_t g = 0; g < a.groups.size(); ++g) {
    CHECK(a.groups[g].name == b.groups[g].name);
    CHECK(a.groups[g].kind == b.groups[g].kind);
    CHECK(a.groups[g].faces == b.groups[g].faces);
  }
  CHECK(a.material_libraries == b.material_libraries);
  REQUIRE(a.maps.size() == b.maps.size());
  for (std::size_t m = 0; m < a.maps.size(); ++m) {
    CHECK(a.maps[m].name == b.maps[m].name);
    CHECK(a.maps[m].values == b.maps[m].values);
  }
}

}  // namespace pliant_tests
