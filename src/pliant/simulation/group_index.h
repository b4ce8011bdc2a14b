#pragma once
// Who has a name and who holds a vertex, among thousands of groups.
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>

#include "pliant/simulation/records.h"

namespace pliant {

class GroupIndex {
 public:
  void add(GroupId id, const Group& group);
  void remove(GroupId id, const Group& group);

  /// The group of that name; of several, the one that was added first.
  std::optional<GroupId> find(std::string_view name) const;
  /// The group that holds a vertex exactly (hard pins).
  std::optional<GroupId> holder(Index vertex) const;

 private:
  std::set<std::pair<std::string, GroupId>, std::less<>> names_;
  std::unordered_map<Index, GroupId> holders_;
};

}  // namespace pliant
