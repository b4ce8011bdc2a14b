#include "pliant_io/scene/detail/read_release.h"

#include <algorithm>
#include <map>

#include "pliant_io/scene/detail/option_reader.h"
#include "pliant_io/scene/detail/read_motion.h"

namespace pliant {
namespace {

bool contains(const std::vector<Index>& sorted, Index number) {
  return std::ranges::binary_search(sorted, number);
}

}  // namespace

std::vector<Index> read_released(const Node& node, const SceneBody& body, const std::vector<Index>& pinned) {
  Selection selection = read_selection(node, body);
  if (selection.everything) return pinned;
  if (node.is_list()) return selection.vertices;
  std::ranges::sort(selection.vertices);
  std::vector<Index> released;
  std::ranges::copy_if(pinned, std::back_inserter(released), [&](Index v) { return contains(selection.vertices, v); });
  if (released.empty()) node.fail("the group holds none of these vertices; select others");
  return released;
}

std::vector<Index> read_released_numbers(const Node& node, const Group& group, const std::vector<Index>& pinned) {
  ConstraintNumbers numbers;
  read(node, numbers);
  std::map<Index, Index> vertices;  // by number
  for (std::size_t i = 0; i < pinned.size(); ++i) vertices.emplace(group.points[i], pinned[i]);
  for (Index& number : numbers) {
    const auto found = vertices.find(number);
    if (found == vertices.end()) {
      node.fail(
          fmt::format("the group has no constraint {} then; it began with 0 to {}", number, group.next_point - 1));
    }
    number = found->second;
  }
  return numbers;
}

void leave_out(std::vector<Index> released, const std::vector<Index>& pinned, Position& options) {
  std::ranges::sort(released);
  Stencils stencils;
  std::vector<Real> stiffness;
  for (std::size_t i = 0; i < pinned.size(); ++i) {
    if (contains(released, pinned[i])) continue;
    stencils.add({pinned[i]});
    if (options.stiffness.each()) stiffness.push_back(options.stiffness[static_cast<Index>(i)]);
  }
  options.on = stencils.empty() ? Selection(std::vector<Index>{}) : Selection();
  if (options.stiffness.each()) options.stiffness = Values(std::move(stiffness));
  options.stencils = std::move(stencils);
  options.targets = {};  // a group that is made anew keeps those there are
}

}  // namespace pliant
