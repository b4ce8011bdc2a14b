#pragma once
// What the targets of mesh formats share: any bytes make an Error or a mesh that is sound as data, and what is written
// of it reads back as the same mesh.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <unistd.h>

#include "fuzz.h"
#include "pliant/mesh/diagnosis.h"
#include "pliant/mesh/geometry.h"
#include "pliant_io/files/read_file.h"
#include "pliant_io/mesh/mesh_file.h"

namespace pliant_fuzz {

/// A sound element: its vertices are in range, and none stands twice.
template <class Corners>
bool is_element(const Corners& corners, pliant::Index vertex_count) {
  const std::set<pliant::Index> vertices(corners.begin(), corners.end());
  return vertices.size() == corners.size() && *vertices.begin() >= 0 && *vertices.rbegin() < vertex_count;
}

template <class Elements>
void check_elements(const Elements& elements, pliant::Index vertex_count) {
  for (const auto& corners : elements) require(is_element(corners, vertex_count), "an element is not sound");
}

inline void check_polygons(const pliant::Mesh& mesh) {
  const pliant::PolygonFaces& faces = mesh.faces;
  if (faces.offsets.empty()) return require(faces.vertices.empty(), "corners without polygons");
  require(faces.offsets.front() == 0 && faces.offsets.back() == std::ssize(faces.vertices), "corners of no polygon");
  std::size_t triangle_count = 0;
  for (std::size_t f = 0; f + 1 < faces.offsets.size(); ++f) {
    require(faces.offsets[f + 1] >= faces.offsets[f] + 3, "a polygon of fewer than three corners");
    const std::vector<pliant::Index> corners(faces.vertices.begin() + faces.offsets[f],
                                             faces.vertices.begin() + faces.offsets[f + 1]);
    require(is_element(corners, mesh.vertex_count()), "a polygon is not sound");
    triangle_count += corners.size() - 2;
  }
  require(mesh.triangles.size() == triangle_count, "triangles that are not those of the polygons");
  require(faces.texture_coordinates.empty() || faces.texture_coordinates.size() == faces.vertices.size(),
          "texture coordinates of some corners only");
  for (const pliant::Index row : faces.texture_coordinates) {
    require(row >= -1 && row < mesh.texture_coordinates.rows(), "a texture coordinate is out of range");
  }
}

/// What mesh_file.h promises of every mesh that was read.
inline void check_sound(const pliant::Mesh& mesh) {
  require(mesh.vertex_count() > 0 && mesh.vertices.allFinite(), "a coordinate is not finite, or there is no vertex");
  require(mesh.texture_coordinates.allFinite(), "a texture coordinate is not finite");
  check_elements(mesh.edges, mesh.vertex_count());
  check_elements(mesh.triangles, mesh.vertex_count());
  check_elements(mesh.tetrahedra, mesh.vertex_count());
  check_polygons(mesh);
  for (const pliant::FaceGroup& group : mesh.groups) {
    require(!group.faces.empty(), "a group without faces");
    for (const pliant::Index face : group.faces) {
      require(face >= 0 && face < mesh.faces.face_count(), "a face of a group is out of range");
    }
  }
  std::set<std::string> names;
  for (const pliant::VertexMap& map : mesh.maps) {
    require(names.insert(map.name).second, "two maps of one name");
    require(std::ssize(map.values) == mesh.vertex_count(), "a map of another length");
    require(std::ranges::all_of(map.values, [](pliant::Real x) { return std::isfinite(x); }), "a map is not finite");
  }
}

/// check_mesh refuses a mesh exactly when diagnose finds what is refused.
inline void check_diagnosis(const pliant::Mesh& mesh) {
  const pliant::Diagnosis diagnosis = pliant::diagnose(mesh);
  const bool has_refused = std::ranges::any_of(diagnosis.defects, [](const pliant::Defect& defect) {
    return pliant::info_of(defect.kind).effect == pliant::DefectEffect::refused;
  });
  bool is_refused = false;
  try {
    pliant::check_mesh(mesh, "fuzz");
  } catch (const pliant::Error&) {
    is_refused = true;
  }
  require(has_refused == is_refused, "diagnose and check_mesh do not agree");
}

/// The format that a mesh of a format is written in; TetGen's and VTK's legacy files are only read.
inline pliant::MeshFormat output_format(const pliant::MeshFormat& format) {
  if (format.name == "vtk") return pliant::require_mesh_format("x.vtu");
  return format.write == nullptr ? pliant::require_mesh_format("x.msh") : format;
}

/// The bytes of the file that a mesh is written to.
inline std::string written(const pliant::Mesh& mesh, const pliant::MeshFormat& format) {
  const std::string name = "pliant_fuzz_" + std::to_string(getpid()) + "." + std::string(format.extensions[0]);
  const std::filesystem::path path = std::filesystem::temp_directory_path() / name;
  pliant::write_mesh(path, mesh, mesh.vertices);
  std::string bytes = pliant::read_file(path);
  std::filesystem::remove(path);
  return bytes;
}

/// Names of groups change once where a file cannot hold them: control characters, a backslash.
inline bool has_plain_names(const pliant::Mesh& mesh) {
  return std::ranges::all_of(mesh.groups, [](const pliant::FaceGroup& group) {
    return std::ranges::all_of(group.name, [](char c) { return static_cast<unsigned char>(c) >= ' ' && c != '\\'; });
  });
}

/// What is written of the mesh reads back as it is, and is written again as the same bytes.
inline void check_round_trip(const pliant::Mesh& mesh, const pliant::MeshFormat& format) {
  try {
    const std::string bytes = written(mesh, format);
    const pliant::Mesh again = pliant::parse_mesh(bytes, "written", format);
    require(again.vertex_count() == mesh.vertex_count() && again.vertices == mesh.vertices, "a file changes vertices");
    require(again.triangles == mesh.triangles, "a file changes triangles");
    require(again.tetrahedra == mesh.tetrahedra, "a file changes tetrahedra");
    require(again.edges == mesh.edges, "a file changes edges");
    require(!has_plain_names(mesh) || written(again, format) == bytes, "a file changes as it is read and written");
  } catch (const pliant::Error& error) {
    require(false, error.what());
  }
}

/// STL as it is read back keeps neither lone vertices nor digits, and points may become one; after that nothing
/// changes.
inline pliant::Mesh settled(const pliant::Mesh& mesh, const pliant::MeshFormat& format) {
  if (format.name != "stl") return mesh;
  const pliant::Mesh rounded = pliant::parse_mesh(written(mesh, format), "rounded", format);
  return pliant::parse_mesh(written(rounded, format), "settled", format);
}

inline int fuzz_mesh(const std::uint8_t* data, std::size_t size, const pliant::MeshFormat& format) {
  expect_errors_only([&] {
    const pliant::Mesh mesh = pliant::parse_mesh(text(data, size), "fuzz", format);
    check_sound(mesh);
    check_diagnosis(mesh);
    const pliant::MeshFormat output = output_format(format);
    check_round_trip(settled(mesh, output), output);
  });
  return 0;
}

}  // namespace pliant_fuzz
