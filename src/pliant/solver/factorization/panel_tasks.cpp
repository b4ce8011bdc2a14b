#include "pliant/solver/factorization/panel_tasks.h"

#include <algorithm>
#include <queue>

namespace pliant {
namespace {

// A task shall take several times as long as handing it out (a microsecond), and there shall be enough of them for
// many threads to be busy all the time.
constexpr std::int64_t min_task_weight = 20'000;
constexpr std::int64_t wanted_tasks = 64;

/// Subtrees of panels in postorder.
struct Subtrees {
  std::vector<Index> first;          // the first panel of the subtree of each
  std::vector<std::int64_t> weight;  // of the whole subtree
  bool is_postordered = true;
};

Subtrees find_subtrees(const std::vector<PanelShape>& panels) {
  const std::size_t count = panels.size();
  Subtrees trees{std::vector<Index>(count), std::vector<std::int64_t>(count), true};
  std::vector<Index> size(count, 1);
  for (std::size_t p = 0; p < count; ++p) trees.weight[p] = panels[p].weight;
  for (std::size_t p = 0; p < count; ++p) {
    trees.first[p] = static_cast<Index>(p) - size[p] + 1;
    const Index parent = panels[p].parent;
    if (parent < 0) continue;
    if (parent <= static_cast<Index>(p)) return {{}, {}, false};
    size[static_cast<std::size_t>(parent)] += size[p];
    trees.weight[static_cast<std::size_t>(parent)] += trees.weight[p];
  }
  for (std::size_t p = 0; p < count && trees.is_postordered; ++p) {
    const Index parent = panels[p].parent;
    // In a postorder the subtree of the parent has that of each child.
    trees.is_postordered =
        trees.first[p] >= 0 && (parent < 0 || trees.first[static_cast<std::size_t>(parent)] <= trees.first[p]);
  }
  return trees;
}

/// The roots of the subtrees that are left when the heaviest ones are taken apart, in ascending order.
std::vector<Index> choose_roots(const std::vector<PanelShape>& panels, const Subtrees& trees) {
  std::vector<std::vector<Index>> children(panels.size());
  const auto lighter = [&](Index a, Index b) {
    return std::pair(trees.weight[static_cast<std::size_t>(a)], -a) <
           std::pair(trees.weight[static_cast<std::size_t>(b)], -b);
  };
  std::priority_queue<Index, std::vector<Index>, decltype(lighter)> queue(lighter);
  std::int64_t total = 0;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    total += panels[p].weight;
    if (panels[p].parent < 0) {
      queue.push(static_cast<Index>(p));
    } else {
      children[static_cast<std::size_t>(panels[p].parent)].push_back(static_cast<Index>(p));
    }
  }
  const std::int64_t small_enough = std::max(min_task_weight, total / wanted_tasks);
  while (!queue.empty() && trees.weight[static_cast<std::size_t>(queue.top())] > small_enough) {
    const Index root = queue.top();
    queue.pop();
    for (const Index child : children[static_cast<std::size_t>(root)]) queue.push(child);
  }
  std::vector<Index> roots;
  for (; !queue.empty(); queue.pop()) roots.push_back(queue.top());
  std::ranges::sort(roots);
  return roots;
}

}  // namespace

std::vector<PanelTask> divide(const std::vector<PanelShape>& panels) {
  const Subtrees trees = find_subtrees(panels);
  if (!trees.is_postordered) return {};
  std::vector<PanelTask> tasks;
  std::int64_t weight = 0;  // of the last task
  for (const Index root : choose_roots(panels, trees)) {
    const auto place = static_cast<std::size_t>(root);
    const PanelTask task{trees.first[place], root + 1};
    const bool is_next = !tasks.empty() && tasks.back().end == task.begin;
    if (is_next && weight + trees.weight[place] <= min_task_weight) {
      tasks.back().end = task.end;
      weight += trees.weight[place];
    } else {
      tasks.push_back(task);
      weight = trees.weight[place];
    }
  }
  return tasks;
}

}  // namespace pliant
