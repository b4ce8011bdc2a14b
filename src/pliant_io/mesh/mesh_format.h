#pragma once
// The list of mesh formats. A new one is a pair of files with its reader and its writer, and an include and an entry in
// mesh_format.cpp: messages, commands and tests follow from the list.
#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "pliant/mesh/mesh.h"

namespace pliant {

class ByteSource;

/// A file format of meshes.
struct MeshFormat {
  std::string_view name;                       ///< what `pliant info` calls it
  std::array<std::string_view, 2> extensions;  ///< small letters behind the point; the second may be empty

  /// The mesh as the file has it, before it is scaled and turned. @throws Error (input) with its place in the file
  Mesh (*read)(const ByteSource& source);

  /// As write_mesh in mesh_file.h; null for a format that is only read.
  void (*write)(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions) = nullptr;

  /// Of a format of two files, the first extension's and the second's, of which either may be named; else null. `read`
  /// then takes them one after the other.
  Mesh (*read_pair)(const ByteSource& first, const ByteSource& second) = nullptr;
};

/// All of them, in the order in which messages name them.
std::span<const MeshFormat> mesh_formats();

/// The format that the extension stands for, in capitals or not; none when it stands for no known one.
std::optional<MeshFormat> mesh_format(const std::filesystem::path& path);
/// The same. @throws Error (input), listing the known ones
MeshFormat require_mesh_format(const std::filesystem::path& path);

/// The extensions of files that read_mesh and write_mesh take, without the point.
std::vector<std::string_view> readable_mesh_extensions();
std::vector<std::string_view> writable_mesh_extensions();

}  // namespace pliant
