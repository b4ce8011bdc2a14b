#pragma once
// VTK's files of meshes in, .vtu out, behind read_mesh and write_mesh in mesh_file.h.
#include <filesystem>

#include "pliant/mesh/mesh.h"

namespace pliant {

class ByteSource;

/// Reads a legacy .vtk file, ASCII or binary, of version 1 to 5: an UNSTRUCTURED_GRID or POLYDATA. Cells are lines and
/// polylines, triangles, quadrilaterals, pixels, polygons, strips and tetrahedra. Faces beside tetrahedra are left out,
/// and lines that are edges of others: they are borders. What belongs to points and cells is not read.
/// @throws Error (input) with the line of a text or the byte of a binary file: a malformed or truncated one, another
/// dataset, cells of other types.
Mesh read_vtk(const ByteSource& source);

/// Reads an UnstructuredGrid of VTK's XML: arrays as text, in base64 or appended, raw or in base64, compressed by zlib
/// or not, in either order of bytes; cells as read_vtk. Arrays of points with one number each become maps, unless one
/// of their numbers is not finite. Pieces follow each other.
/// @throws Error (input) with the line of the XML: as read_vtk, and other compressors.
Mesh read_vtu(const ByteSource& source);

/// Writes the mesh as write_mesh does (mesh_file.h), with its tetrahedra, else its polygons, and its edges and maps:
/// numbers in double precision, compressed by zlib, in base64. Lost: groups and texture coordinates.
void write_vtu(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions);

}  // namespace pliant
