#pragma once
// Wavefront OBJ in and out, behind read_mesh and write_mesh in mesh_file.h.
#include <filesystem>

#include "pliant/mesh/mesh.h"

namespace pliant {

class ByteSource;

/// Reads an OBJ file.
///
/// Kept: `v` (x y z; a weight or a color behind them is checked and dropped), `vt` (u v), `f` in all forms (v, v/vt,
/// v//vn, v/vt/vn; negative indices count back from the last; polygons of any size, also cut into triangles as a fan
/// from their first corner), `l` as edges, `g` and `o` as groups (those that have faces). Every other keyword is passed
/// over. Line ends may be LF, CRLF or CR; a backslash at the end of a line continues it.
/// @throws Error (input) `file:line: what; remedy`: not a regular readable file, a NUL byte, a malformed or non-finite
///   number, an index that is 0 or out of range, a face with fewer than three corners or a repeated one, a line with
///   fewer than two vertices, too few or too many coordinates, no vertices, more than 2³¹ − 1 of anything.
Mesh read_obj(const ByteSource& source);

/// Writes the mesh with `positions` [m] (m × 3) in place of its rest positions, whole or not at all (atomic_file.h):
/// the polygons if the mesh came from polygons, else its triangles, else the surface of its tetrahedra; texture
/// coordinates, groups and edges as well. Numbers are the shortest that read back to the same bits, so that reading,
/// writing and reading again gives the same mesh.
/// @throws Error (input): a count of positions other than the mesh's, a position that is not finite.
/// @throws Error (output): the file cannot be written.
void write_obj(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions);

}  // namespace pliant
