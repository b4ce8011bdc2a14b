#include "pliant/solver/global/factorization/panel_tasks.h"

#include <algorithm>
#include <array>
#include <queue>
#include <utility>

namespace pliant {
namespace {

// A task shall take several times as long as handing it out (a microsecond), and there shall be enough of them for
// many threads to be busy all the time. Each level of a dissection has about as many entries as any other, so the
// levels above 64 subtrees hold a good part of a factor; they are taken on in stages with fewer and larger subtrees,
// where a stage is worth the wait for all threads that lies before it.
constexpr std::int64_t min_task_weight = 20'000;
constexpr std::array<std::int64_t, 3> tasks_wanted = {64, 16, 4};
constexpr std::int64_t min_stage_weight = 100'000;

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

/// The roots of the subtrees that are left when the heaviest ones are taken apart until each has at most its share of
/// the whole, in ascending order.
std::vector<Index> choose_roots(const std::vector<PanelShape>& panels, const Subtrees& trees, std::int64_t shares) {
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
  const std::int64_t small_enough = std::max(min_task_weight, total / shares);
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

/// The panels of [begin, end) that are not taken; takes them.
std::vector<PanelRange> take(Index begin, Index end, std::vector<char>& is_taken) {
  std::vector<PanelRange> ranges;
  for (Index p = begin; p < end; ++p) {
    char& taken = is_taken[static_cast<std::size_t>(p)];
    if (taken != 0) continue;
    taken = 1;
    if (!ranges.empty() && ranges.back().end == p) {
      ++ranges.back().end;
    } else {
      ranges.push_back({p, p + 1});
    }
  }
  return ranges;
}

std::int64_t weight_of(const std::vector<PanelShape>& panels, const std::vector<PanelRange>& ranges) {
  std::int64_t weight = 0;
  for (const PanelRange& range : ranges) {
    for (Index p = range.begin; p < range.end; ++p) weight += panels[static_cast<std::size_t>(p)].weight;
  }
  return weight;
}

/// Tasks of the subtrees below these roots, small neighbors in one. Takes their panels; returns their weight as well.
std::pair<PanelStage, std::int64_t> make_stage(const std::vector<PanelShape>& panels, const Subtrees& trees,
                                               const std::vector<Index>& roots, std::vector<char>& is_taken) {
  PanelStage stage;
  std::int64_t last = 0;  // weight of the last task
  std::int64_t all = 0;
  for (const Index root : roots) {
    PanelTask task{trees.first[static_cast<std::size_t>(root)], root + 1, {}};
    task.ranges = take(task.begin, task.end, is_taken);
    if (task.ranges.empty()) continue;
    const std::int64_t weight = weight_of(panels, task.ranges);
    all += weight;
    if (!stage.empty() && stage.back().end == task.begin && last + weight <= min_task_weight) {
      last += weight;
      stage.back().end = task.end;
      stage.back().ranges.insert(stage.back().ranges.end(), task.ranges.begin(), task.ranges.end());
    } else {
      last = weight;
      stage.push_back(std::move(task));
    }
  }
  return {std::move(stage), all};
}

}  // namespace

std::vector<PanelStage> divide(const std::vector<PanelShape>& panels) {
  const Subtrees trees = find_subtrees(panels);
  if (!trees.is_postordered) return {};
  std::vector<PanelStage> stages;
  std::vector<char> is_taken(panels.size(), 0);
  for (const std::int64_t shares : tasks_wanted) {
    std::vector<char> taken = is_taken;
    auto [stage, weight] = make_stage(panels, trees, choose_roots(panels, trees, shares), taken);
    if (stage.empty() || (!stages.empty() && (stage.size() < 2 || weight < min_stage_weight))) continue;
    is_taken = std::move(taken);
    stages.push_back(std::move(stage));
  }
  return stages;
}

}  // namespace pliant
