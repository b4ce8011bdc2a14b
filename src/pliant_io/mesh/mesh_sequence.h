#pragma once
// Frames that are a mesh file each: walk_001.obj, walk_002.obj, ...
#include <cstdint>
#include <filesystem>
#include <vector>

#include "pliant_io/mesh/point_cache.h"

namespace pliant {

/// One file of a sequence.
struct SequenceFile {
  std::int64_t number = 0;  ///< in its name
  std::filesystem::path path;
};

/// Whether the last part of a path has a star: `walk_*.obj`.
bool is_mesh_sequence(const std::filesystem::path& pattern);

/// The files whose names are the pattern with a number of up to 15 digits in place of its star, by their numbers.
/// @throws Error (input): more than one star, a folder that cannot be read, no such file, two of one number
std::vector<SequenceFile> sequence_files(const std::filesystem::path& pattern);

/// Reads the vertices of all of these files (read_mesh). The first one is at 0 s, and a file whose number is larger by
/// n is n / frames_per_second later, whether or not there are files for the numbers between.
/// @throws Error (input) naming the file: it cannot be read as a mesh, or has another count of vertices than the first;
///   no files; options out of range.
PointCache read_mesh_sequence(const std::vector<SequenceFile>& files, const PointCacheOptions& options = {});

}  // namespace pliant
