#pragma once
// Meshes from files of every format and into them, chosen by the extension. docs/formats.md says what each one holds.
#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

#include "pliant/core/options.h"
#include "pliant/mesh/mesh.h"
#include "pliant_io/mesh/mesh_format.h"

namespace pliant {

/// Which axis of a file points up.
enum class UpAxis { z, y, x };
constexpr std::array<std::string_view, 3> choice_names(UpAxis) {
  return {"z", "y", "x"};
}

/// How the coordinates of a file become meters with +z up.
struct ImportOptions {
  Real scale = 1;           ///< meters per unit of the file [m], > 0: 0.001 where it counts in millimeters
  UpAxis up = UpAxis::z;    ///< the file's axis that becomes +z
  bool drop_loose = false;  ///< leaves out vertices that no element has; the others are numbered anew

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"scale", "m", "meters per unit of the file: 0.001 where it counts in millimeters", positive},
          self.scale);
    field(OptionInfo{"up", "", "the file's axis that points up, turned to +z: `z` (as it is), `y` or `x`"}, self.up);
    field(OptionInfo{"drop_loose", "", "leaves out vertices that no element has; the others are numbered anew"},
          self.drop_loose);
  }
};

/// Reads the mesh of a file: its vertices in their order and number, polygons, edges, groups, texture coordinates and
/// per-vertex numbers, as far as the format holds them; of TetGen's pair of files either may be named. Then it is
/// scaled and turned: `y` up takes (x, y, z) to (x, −z, y), `x` up to (−z, y, x), both without mirroring. Loose
/// vertices are kept unless `drop_loose` is set.
///
/// What comes out is sound as data (indices in range, coordinates finite, no vertex twice in an element), but may have
/// elements without extent, which check_mesh in geometry.h refuses and diagnose in diagnosis.h lists.
/// @throws Error (input), one line with the place in the file and the remedy: an extension that is not known, a file
///   that cannot be read, a malformed or truncated one, options out of range. Reading takes less than ten times the
///   memory of the file, whatever it claims to hold; of a compressed one, of 64 times its size and 16 MiB.
Mesh read_mesh(const std::filesystem::path& path, const ImportOptions& options = {});

/// Scales and turns positions (m × 3) of a file as read_mesh does. `name` is what messages call it.
/// @throws Error (input): options out of range, a vertex that is not finite once scaled
void import_positions(Positions& positions, const ImportOptions& options, std::string_view name);

/// The files that read_mesh reads: that one, and of TetGen's pair the other, points first. @throws Error (input): as
/// require_mesh_format
std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& path);

/// The same from bytes in memory, of TetGen the two files one after the other. `name` is what messages call them.
Mesh parse_mesh(std::string_view bytes, std::string_view name, const MeshFormat& format,
                const ImportOptions& options = {});

/// Writes the mesh with `positions` [m] (m × 3) in place of its rest positions, whole or not at all (atomic_file.h), in
/// the format of the extension: polygons where the mesh came from polygons, else its triangles, else the surface of its
/// tetrahedra (Gmsh and MEDIT: the tetrahedra themselves), and with them what the format holds. Coordinates stay in
/// meters with +z up.
/// @throws Error (input): an extension that is not known or that is only read, a count of positions other than the
/// mesh's,
///   a position that is not finite or that the format cannot hold.
/// @throws Error (output): the file cannot be written.
void write_mesh(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions);

}  // namespace pliant
