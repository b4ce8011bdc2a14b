#pragma once
// The current object, groups and material while an OBJ file is read, and the groups that its faces make of them.
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pliant/mesh/mesh.h"

namespace pliant {

/// Groups come into being with their first face, so that their order does not change when the mesh is written. Names
/// and memberships are held to a share of the file's size: few bytes of names for many faces would otherwise take a
/// quadratic amount of memory. Members return what is wrong, as an error message without its place, or nothing.
class FaceGroupsBuilder {
 public:
  FaceGroupsBuilder(Mesh& mesh, std::uint64_t file_size);

  /// Leaves all groups.
  void clear_groups();
  /// Enters one more group.
  std::string add_group(std::string_view name);
  /// The object or the material from now on; none when the name is empty.
  void set_name(FaceGroupKind kind, std::string name);

  /// Puts a face into what is current.
  std::string add_face(Index face);

 private:
  std::string enter_current();
  std::string enter(FaceGroupKind kind, const std::string& name);

  Mesh& mesh_;
  std::uint64_t max_groups_;
  std::uint64_t memberships_left_;
  std::string object_;
  std::string material_;
  std::vector<std::string> group_names_;
  bool is_current_ = true;            ///< current_ is what the names say
  std::vector<std::size_t> current_;  ///< of Mesh::groups
  std::map<std::pair<FaceGroupKind, std::string>, std::size_t> index_;
};

}  // namespace pliant
