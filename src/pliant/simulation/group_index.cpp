#include "pliant/simulation/group_index.h"

#include <limits>

namespace pliant {

void GroupIndex::add(GroupId id, const Group& group) {
  names_.emplace(group.name, id);
  for (const auto& batch : group.set.batches) {
    for (const Index vertex : batch->pinned_vertices()) holders_.insert_or_assign(vertex, id);
  }
}

void GroupIndex::remove(GroupId id, const Group& group) {
  names_.erase({group.name, id});
  for (const auto& batch : group.set.batches) {
    for (const Index vertex : batch->pinned_vertices()) {
      const auto found = holders_.find(vertex);
      if (found != holders_.end() && found->second == id) holders_.erase(found);
    }
  }
}

std::optional<GroupId> GroupIndex::find(std::string_view name) const {
  const auto found = names_.lower_bound({std::string(name), GroupId(std::numeric_limits<Index>::min())});
  if (found == names_.end() || found->first != name) return std::nullopt;
  return found->second;
}

std::optional<GroupId> GroupIndex::holder(Index vertex) const {
  const auto found = holders_.find(vertex);
  return found == holders_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace pliant
