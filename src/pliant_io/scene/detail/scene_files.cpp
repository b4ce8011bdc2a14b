#include "pliant_io/scene/detail/scene_files.h"

#include <algorithm>

#include "pliant_io/files/crc32.h"
#include "pliant_io/files/read_file.h"
#include "pliant_io/scene/detail/json_values.h"

namespace pliant {

std::string SceneFiles::read(const std::filesystem::path& path) {
  std::string bytes = read_file(path);
  if (std::ranges::find(files_, path.string(), &SceneFile::path) == files_.end()) {
    files_.push_back({path.string(), bytes.size(), crc32(bytes)});
  }
  return bytes;
}

namespace {

SceneFiles& files_of(const Node& node) {
  if (node.origin().files == nullptr) node.fail("a file cannot be named here; write the values themselves");
  return *node.origin().files;
}

}  // namespace

std::filesystem::path read_path(const Node& node) {
  std::string name;
  read(node, name);
  if (name.empty()) node.fail("the path is empty; give that of a file");
  if (name.find('\0') != name.npos) node.fail("a path cannot have the character \\u0000; take it out");
  return node.origin().folder / name;
}

std::filesystem::path absolute_path(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path current = std::filesystem::current_path(error);
  return (current / path).lexically_normal();
}

NamedFile read_named_file(const Node& node) {
  NamedFile file;
  file.path = read_path(node);
  file.bytes = node.locate([&] { return files_of(node).read(file.path); });
  return file;
}

void note_file(const Node& node, const std::filesystem::path& path) {
  files_of(node).read(path);
}

}  // namespace pliant
