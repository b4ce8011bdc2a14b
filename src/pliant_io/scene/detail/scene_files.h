#pragma once
// Every file that a scene names is read here, so that it is known which they were.
#include "pliant_io/scene/detail/json_node.h"
#include "pliant_io/scene/scene_source.h"

namespace pliant {

class SceneFiles {
 public:
  /// The bytes of a file, which is noted. @throws Error (input) as read_file does.
  std::string read(const std::filesystem::path& path);

  /// The files read so far, each once.
  const std::vector<SceneFile>& files() const { return files_; }

 private:
  std::vector<SceneFile> files_;
};

/// The path that a value names: relative ones start at the folder of the text that it stands in.
/// @throws Error (input) with the place of a value that is no text, is empty or has a character that no path can have.
std::filesystem::path read_path(const Node& node);

/// The same path from the root, without . and ..; as it is where there is no current folder any longer.
std::filesystem::path absolute_path(const std::filesystem::path& path);

/// A file that a value names, with its path.
struct NamedFile {
  std::filesystem::path path;
  std::string bytes;
};
NamedFile read_named_file(const Node& node);
/// Notes a file that a value names and another function reads.
void note_file(const Node& node, const std::filesystem::path& path);

}  // namespace pliant
