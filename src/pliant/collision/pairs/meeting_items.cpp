#include "pliant/collision/pairs/meeting_items.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <utility>

namespace pliant::collision {
namespace {

constexpr std::size_t task_count = 128;
/// Pairs of boxes that are to be there before they are shared out among tasks, if the trees have as many.
constexpr std::size_t nodes_to_share = 1024;
/// Pairs that a task may find before it looks at how many there are in all.
constexpr std::size_t hits_between_looks = 4096;

/// Threads that put pairs in order: each has a place for every item.
constexpr int most_parts = 8;

constexpr Index group_size = static_cast<Index>(boxes_side_by_side);

/// Of the 8 × 8 pairs of a group with itself: each once, with or without those of a box with itself.
constexpr std::uint64_t once(std::size_t first_other) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < boxes_side_by_side; ++i) {
    for (std::size_t j = i + first_other; j < boxes_side_by_side; ++j) bits |= std::uint64_t{1} << (8 * i + j);
  }
  return bits;
}

/// Bit 8 i + j: box i of group_a of a level meets box j of group_b, and is not in excluded(i), which has a bit for each
/// j. Of one tree each two boxes once.
template <class Excluded>
std::uint64_t meeting(const BoxTree& a, const BoxTree& b, Index level, Index group_a, Index group_b,
                      std::uint64_t once_in_one_group, Excluded&& excluded) {
  const EightBoxes& eight_a = a.level(level)[at(group_a)];
  const EightBoxes& eight_b = b.level(level)[at(group_b)];
  // More than half of the boxes of a do not reach the hull of those of b, which the level above has.
  unsigned rows = 255;
  if (level + 1 < b.height()) {
    const EightBoxes& hulls = b.level(level + 1)[at(group_b / group_size)];
    rows = meeting_row(hulls, at(group_b % group_size), eight_a);
  }
  std::uint64_t bits = 0;
  for (; rows != 0; rows &= rows - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(rows));
    const unsigned row = meeting_row(eight_a, i, eight_b) & ~excluded(i);
    bits |= std::uint64_t{row} << (boxes_side_by_side * i);
  }
  return &a == &b && group_a == group_b ? bits & once_in_one_group : bits;
}

/// Calls visit(box_a, box_b) for boxes of a level, in group_a and group_b of it, that meet.
template <class Visit>
void visit_boxes(const Surface& surface, const OwnedTree& a, const OwnedTree& b, Index level, Index group_a,
                 Index group_b, Visit&& visit) {
  const auto none_excluded = [](std::size_t) { return 0U; };
  std::uint64_t bits = meeting(*a.tree, *b.tree, level, group_a, group_b, once(0), none_excluded);
  for (; bits != 0; bits &= bits - 1) {
    const int bit = std::countr_zero(bits);
    const Index box_a = group_size * group_a + bit / group_size;
    const Index box_b = group_size * group_b + bit % group_size;
    if (a.owners != nullptr && !TreeOwners::may_meet(surface, *a.owners, box_a, *b.owners, box_b, level)) continue;
    if (a.places != nullptr && TreePlaces::are_apart(*a.sheets, *a.places, box_a, *b.places, box_b, level)) continue;
    visit(box_a, box_b);
  }
}

/// Goes down two trees, whose items have so many corners. Calls meet(group_a, group_b, bits) with bit 8 i + j where
/// item i of the first group and item j of the second make a pair; goes on while is_wanted().
template <Index corners_a, Index corners_b, class Meet, class IsWanted>
class Descent {
 public:
  Descent(const Surface& surface, const OwnedTree& a, const OwnedTree& b, Meet meet, IsWanted is_wanted)
      : surface_(surface), a_(a), b_(b), meet_(meet), is_wanted_(is_wanted) {}

  void go(Index level, Index group_a, Index group_b) {
    if (level == 0) return meet_items(group_a, group_b);
    visit_boxes(surface_, a_, b_, level, group_a, group_b, [&](Index box_a, Index box_b) {
      if (is_wanted_()) go(level - 1, box_a, box_b);
    });
  }

 private:
  void meet_items(Index group_a, Index group_b) {
    std::uint64_t bits = meeting(*a_.tree, *b_.tree, 0, group_a, group_b, once(1),
                                 [&](std::size_t i) { return sharing(group_a, i, group_b); });
    if (a_.owners != nullptr) bits = wanted(bits, group_a, group_b);
    if (bits != 0) meet_(group_a, group_b, bits);
  }

  /// Bit j: item j has a corner of item i.
  unsigned sharing(Index group_a, std::size_t i, Index group_b) const {
    const Index* const vertices_a = a_.tree->corners_of_group(group_a) + i;
    const Index* const vertices_b = b_.tree->corners_of_group(group_b);
    // Sums of −1 for each match, since compilers make detours of an OR here.
    FourIndices first_four{}, last_four{};
    for (Index c = 0; c < corners_a; ++c) {
      const FourIndices vertex = four_of(vertices_a[group_size * c]);
      for (Index d = 0; d < corners_b; ++d) {
        first_four += vertex == four_at(vertices_b + group_size * d);
        last_four += vertex == four_at(vertices_b + group_size * d + 4);
      }
    }
    return bits_of(first_four) | bits_of(last_four) << 4U;
  }

  std::uint64_t wanted(std::uint64_t bits, Index group_a, Index group_b) const {
    for (std::uint64_t rest = bits; rest != 0; rest &= rest - 1) {
      const int bit = std::countr_zero(rest);
      if (!TreeOwners::may_meet(surface_, *a_.owners, group_size * group_a + bit / group_size, *b_.owners,
                                group_size * group_b + bit % group_size, 0)) {
        bits &= ~(std::uint64_t{1} << bit);
      }
    }
    return bits;
  }

  const Surface& surface_;
  OwnedTree a_, b_;
  Meet meet_;
  IsWanted is_wanted_;
};

/// Calls use(descent) with the descent for the corners of the items.
template <class Meet, class IsWanted, class Use>
void descend(const Surface& surface, const OwnedTree& a, const OwnedTree& b, Meet& meet, IsWanted& is_wanted,
             Use&& use) {
  const auto with = [&]<Index corners_a, Index corners_b>(std::integer_sequence<Index, corners_a, corners_b>) {
    Descent<corners_a, corners_b, Meet&, IsWanted&> descent(surface, a, b, meet, is_wanted);
    use(descent);
  };
  if (a.tree->corner_count() == 2) {
    with(std::integer_sequence<Index, 2, 2>());
  } else if (b.tree->corner_count() == 3) {
    with(std::integer_sequence<Index, 1, 3>());
  } else {
    with(std::integer_sequence<Index, 1, 2>());
  }
}

}  // namespace

void TreeOwners::set(const BoxTree& tree, std::span<const Index> body, std::span<const char> is_held) {
  owners_.resize(at(tree.height()));
  for (Index l = 0; l < tree.height(); ++l) {
    std::vector<Index>& owners = owners_[at(l)];
    owners.assign(boxes_side_by_side * tree.level(l).size(), several);
    for (std::size_t box = 0; box < owners.size(); ++box) {
      if (l == 0) {
        const Index item = tree.items()[box];
        if (item >= 0) owners[box] = 2 * body[at(item)] + (is_held.empty() || is_held[at(item)] == 0 ? 0 : 1);
        continue;
      }
      const std::vector<Index>& below = owners_[at(l - 1)];
      const std::size_t first = boxes_side_by_side * box;
      if (first >= below.size()) continue;
      // Gaps at the end of a group are as the first box: they meet nothing.
      owners[box] = below[first];
      for (std::size_t i = first; i < first + boxes_side_by_side; ++i) {
        if (!tree.level(l - 1)[box].is_empty(i - first) && below[i] != owners[box]) owners[box] = several;
      }
    }
  }
}

bool TreeOwners::may_meet(const Surface& surface, const TreeOwners& a, Index box_a, const TreeOwners& b, Index box_b,
                          Index level) {
  const Index owner_a = a.owners_[at(level)][at(box_a)];
  const Index owner_b = b.owners_[at(level)][at(box_b)];
  if (owner_a == several || owner_b == several) return true;
  return (owner_a % 2 == 0 || owner_b % 2 == 0) && surface.may_meet(owner_a / 2, owner_b / 2);
}

void TreePlaces::set(const Surface& surface, const BoxTree& tree, const FlatSheets& sheets) {
  boxes_.resize(at(tree.height()));
  for (Index l = 0; l < tree.height(); ++l) {
    std::vector<FlatSheets::Box>& boxes = boxes_[at(l)];
    boxes.assign(boxes_side_by_side * tree.level(l).size(), {});
    for (std::size_t box = 0; box < boxes.size(); ++box) {
      if (l == 0) {
        if (tree.items()[box] < 0) continue;
        const std::span<const Index> corners = tree.corners_of(static_cast<Index>(box));
        boxes[box] = sheets.box_of(surface.vertices[at(corners.front())]);
        for (const Index each : corners) boxes[box].add(sheets.box_of(surface.vertices[at(each)]));
        continue;
      }
      const std::vector<FlatSheets::Box>& below = boxes_[at(l - 1)];
      const std::size_t first = boxes_side_by_side * box;
      if (first >= below.size()) continue;
      // Gaps at the end of a group meet nothing.
      boxes[box] = below[first];
      for (std::size_t i = first + 1; i < first + boxes_side_by_side; ++i) {
        if (!tree.level(l - 1)[box].is_empty(i - first)) boxes[box].add(below[i]);
      }
    }
  }
}

bool MeetingItems::find(const Surface& surface, const OwnedTree& a, const OwnedTree& b, std::int64_t most,
                        ThreadPool& pool) {
  tasks_.resize(task_count);
  for (Task& task : tasks_) task.count = 0;
  if (a.tree->item_count() == 0 || b.tree->item_count() == 0) return true;
  nodes_.assign(1, {0, 0});
  Index level = a.tree->height() - 1;
  for (; level > 0 && nodes_.size() < nodes_to_share; --level) {
    next_nodes_.clear();
    for (const Nodes& nodes : nodes_) {
      visit_boxes(surface, a, b, level, nodes.a, nodes.b, [&](Index box_a, Index box_b) {
        next_nodes_.push_back({box_a, box_b});
      });
    }
    nodes_.swap(next_nodes_);
  }
  const bool is_self = a.tree == b.tree;
  std::atomic<std::int64_t> found = 0;
  pool.parallel_for(static_cast<Index>(task_count), [&](Index t) {
    Task& task = tasks_[at(t)];
    std::size_t counted = 0;
    const auto meet = [&](Index group_a, Index group_b, std::uint64_t bits) {
      const Index* const items_a = &a.tree->items()[boxes_side_by_side * at(group_a)];
      const Index* const items_b = &b.tree->items()[boxes_side_by_side * at(group_b)];
      if (task.hits.size() < task.count + 64) task.hits.resize(2 * task.hits.size() + 64);
      for (Hit* to = &task.hits[task.count]; bits != 0; bits &= bits - 1, ++to, ++task.count) {
        const int bit = std::countr_zero(bits);
        const Index x = items_a[bit / group_size], y = items_b[bit % group_size];
        const Index first = is_self ? std::min(x, y) : x;
        *to = {first, x ^ y ^ first};  // the other of the two, without a branch
      }
    };
    bool are_more_wanted = true;
    const auto is_wanted = [&] {
      if (task.count - counted >= hits_between_looks) {
        found += static_cast<std::int64_t>(task.count - counted);
        counted = task.count;
        are_more_wanted = found <= most;
      }
      return are_more_wanted;
    };
    const std::size_t begin = nodes_.size() * at(t) / task_count;
    const std::size_t end = nodes_.size() * (at(t) + 1) / task_count;
    descend(surface, a, b, meet, is_wanted, [&](auto& descent) {
      for (std::size_t n = begin; n < end && is_wanted(); ++n) descent.go(level, nodes_[n].a, nodes_[n].b);
    });
  });
  return count() <= most;
}

Index MeetingItems::crowded_item(const Surface& surface, const OwnedTree& a, const OwnedTree& b, std::int64_t most) {
  std::vector<std::int64_t> counts(at(a.tree->item_count()), 0);
  std::int64_t found = 0;
  const auto meet = [&](Index group_a, Index, std::uint64_t bits) {
    found += std::popcount(bits);
    for (; bits != 0; bits &= bits - 1)
      ++counts[at(a.tree->items()[at(group_size * group_a + std::countr_zero(bits) / 8)])];
  };
  const auto is_wanted = [&] { return found <= most; };
  descend(surface, a, b, meet, is_wanted, [&](auto& descent) { descent.go(a.tree->height() - 1, 0, 0); });
  return static_cast<Index>(std::ranges::max_element(counts) - counts.begin());
}

std::int64_t MeetingItems::count() const {
  std::int64_t sum = 0;
  for (const Task& task : tasks_) sum += static_cast<std::int64_t>(task.count);
  return sum;
}

void MeetingItems::drop_far(PairKind kind, const FarPairs& far, ThreadPool& pool) {
  pool.parallel_for(static_cast<Index>(tasks_.size()), [&](Index t) {
    Task& task = tasks_[at(t)];
    task.count = far.drop(kind, std::span(task.hits).first(task.count));
  });
}

void MeetingItems::drop_joined(PairKind kind, const Surface& surface, ThreadPool& pool) {
  const auto are_joined = [&](const Hit& hit) {
    const JoinedVertices& joined = surface.joined;
    const std::span<const Index> vertex(&surface.vertices[at(kind == PairKind::edge_edge ? 0 : hit.first)], 1);
    if (kind == PairKind::vertex_triangle) return joined.are_joined(vertex, surface.triangles[at(hit.second)]);
    if (kind == PairKind::vertex_edge) {
      return joined.are_joined(vertex, surface.edges[at(surface.loose_begin + hit.second)]);
    }
    return joined.are_joined(surface.edges[at(hit.first)], surface.edges[at(hit.second)]);
  };
  pool.parallel_for(static_cast<Index>(tasks_.size()), [&](Index t) {
    Task& task = tasks_[at(t)];
    const auto end = task.hits.begin() + static_cast<std::ptrdiff_t>(task.count);
    task.count = static_cast<std::size_t>(std::remove_if(task.hits.begin(), end, are_joined) - task.hits.begin());
  });
}

void MeetingItems::sort(Index first_count, ThreadPool& pool) {
  const std::size_t items = at(first_count);
  const Index parts = std::min(pool.active(), most_parts);
  begin_.resize(items + 1);
  places_.resize(at(parts) * items);
  seconds_.resize(static_cast<std::size_t>(count()));
  const auto visit_hits = [&](auto&& visit) {
    pool.parallel_for(parts, [&](Index part) {
      Index* const places = places_.data() + at(part) * items;
      for (std::size_t t = task_count * at(part) / at(parts); t < task_count * at(part + 1) / at(parts); ++t) {
        for (const Hit& hit : std::span(tasks_[t].hits).first(tasks_[t].count)) visit(places[hit.first], hit);
      }
    });
  };
  std::ranges::fill(places_, 0);
  visit_hits([](Index& place, const Hit&) { ++place; });
  // From how many pairs of an item a part has to where the first of them goes.
  Index next = 0;
  for (std::size_t i = 0; i < items; ++i) {
    begin_[i] = next;
    for (std::size_t p = i; p < places_.size(); p += items) {
      const Index pairs = places_[p];
      places_[p] = next;
      next += pairs;
    }
  }
  begin_[items] = next;
  visit_hits([&](Index& place, const Hit& hit) { seconds_[at(place++)] = hit.second; });
  pool.parallel_for(static_cast<Index>(task_count), [&](Index t) {
    const std::size_t end = items * (at(t) + 1) / task_count;
    for (std::size_t i = items * at(t) / task_count; i < end; ++i) {
      std::sort(seconds_.begin() + begin_[i], seconds_.begin() + begin_[i + 1]);
    }
  });
}

}  // namespace pliant::collision
