#include "pliant/collision/pairs/box_tree.h"

#include <algorithm>
#include <limits>

namespace pliant::collision {
namespace {

/// Past this factor of the least spread of a level since the items were put in order, they are to be put in order anew.
constexpr double most_spread = 2;
/// Of the sides of the items: a spread that makes no difference.
constexpr double unnoticed_spread = 0.1;
/// Groups that a thread takes at once.
constexpr Index groups_of_chunk = 256;

/// Of all boxes [m].
double sum_of_sides(std::span<const EightBoxes> boxes) {
  std::array<double, 4> sums{};
  for (const EightBoxes& eight : boxes) {
    FourFloats sides{};
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t i = 0; i < boxes_side_by_side; i += 4) {
        sides += larger(four_at(&eight.high[a][i]) - four_at(&eight.low[a][i]), FourFloats{});
      }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += double{sides[i]};
  }
  return sums[0] + sums[1] + sums[2] + sums[3];
}

std::size_t groups_for(std::size_t boxes) {
  return std::max<std::size_t>(1, (boxes + boxes_side_by_side - 1) / boxes_side_by_side);
}

}  // namespace

BoxTree::BoxTree(std::vector<Index> corners, Index corner_count)
    : corners_(std::move(corners)), corner_count_(corner_count), item_count_(count_of(corners_) / corner_count) {
  std::size_t groups = groups_for(at(item_count_));
  places_.assign(boxes_side_by_side * groups, -1);
  placed_corners_.assign(places_.size() * at(corner_count), -1);
  levels_.emplace_back(groups);
  while (groups > 1) {
    groups = groups_for(groups);
    levels_.emplace_back(groups);
  }
  for (auto& boxes : levels_) {
    for (EightBoxes& eight : boxes) {
      for (std::size_t i = 0; i < boxes_side_by_side; ++i) eight.set_empty(i);
    }
  }
}

void BoxTree::raise(Index height_wanted) {
  while (height() < height_wanted) {
    EightBoxes eight{};
    for (std::size_t i = 0; i < boxes_side_by_side; ++i) eight.set_empty(i);
    levels_.emplace_back(1, eight);
  }
}

FloatBox BoxTree::box_of(const Index* corners, std::size_t stride, std::span<const FloatBox> vertex_boxes) const {
  FloatBox box = vertex_boxes[at(corners[0])];
  for (std::size_t c = 1; c < at(corner_count_); ++c) box.add(vertex_boxes[at(corners[stride * c])]);
  return box;
}

void BoxTree::build(std::span<const FloatBox> vertex_boxes) {
  middles_.resize(at(item_count_));
  for (std::size_t i = 0; i < middles_.size(); ++i) {
    const FloatBox box = box_of(&corners_[at(corner_count_) * i], 1, vertex_boxes);
    const FourFloats middle = box.low * 0.5F + box.high * 0.5F;
    middles_[i] = {{middle[0], middle[1], middle[2]}, static_cast<Index>(i)};
  }
  split(middles_);
  place_items();
  least_spread_.clear();
  ++build_count_;
}

void BoxTree::split(std::span<Middle> middles) {
  if (middles.size() <= boxes_side_by_side) {
    // So that memory is read in its order.
    std::ranges::sort(middles, {}, &Middle::item);
    return;
  }
  std::array<float, 3> low = middles.front().point, high = low;
  for (const Middle& middle : middles) {
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], middle.point[a]), high[a] = std::max(high[a], middle.point[a]);
    }
  }
  std::size_t axis = 0;
  for (std::size_t a = 1; a < 3; ++a) {
    // Half of each, since the difference of the largest numbers is none.
    if (high[a] * 0.5F - low[a] * 0.5F > high[axis] * 0.5F - low[axis] * 0.5F) axis = a;
  }
  std::size_t branch = boxes_side_by_side;
  while (branch * boxes_side_by_side < middles.size()) branch *= boxes_side_by_side;
  const std::size_t half = (middles.size() + branch - 1) / branch / 2 * branch;
  std::ranges::nth_element(middles, middles.begin() + static_cast<std::ptrdiff_t>(half),
                           [&](const Middle& a, const Middle& b) {
                             return a.point[axis] != b.point[axis] ? a.point[axis] < b.point[axis] : a.item < b.item;
                           });
  split(middles.first(half));
  split(middles.subspan(half));
}

void BoxTree::place_items() {
  const std::size_t count = at(corner_count_);
  for (std::size_t place = 0; place < middles_.size(); ++place) {
    const Index item = middles_[place].item;
    places_[place] = item;
    Index* const group = &placed_corners_[place / boxes_side_by_side * boxes_side_by_side * count];
    for (std::size_t c = 0; c < count; ++c) {
      group[boxes_side_by_side * c + place % boxes_side_by_side] = corners_[count * at(item) + c];
    }
  }
}

bool BoxTree::refit(std::span<const FloatBox> vertex_boxes, ThreadPool& pool) {
  if (item_count_ == 0) return true;
  if (build_count_ == 0) return false;
  const auto in_chunks = [&](Index groups, auto&& refit_group) {
    pool.parallel_for((groups + groups_of_chunk - 1) / groups_of_chunk, [&](Index chunk) {
      const Index end = std::min(groups, (chunk + 1) * groups_of_chunk);
      for (Index group = chunk * groups_of_chunk; group < end; ++group) refit_group(group);
    });
  };
  in_chunks(count_of(levels_[0]), [&](Index group) {
    const Index first = group * static_cast<Index>(boxes_side_by_side);
    const std::size_t count = std::min(boxes_side_by_side, at(item_count_ - first));
    const Index* const corners = corners_of_group(group);
    EightBoxes& eight = levels_[0][at(group)];
    if (count < boxes_side_by_side) {
      for (std::size_t i = 0; i < count; ++i) eight.set(i, box_of(corners + i, boxes_side_by_side, vertex_boxes));
      return;
    }
    std::array<FloatBox, boxes_side_by_side> boxes;
    for (std::size_t i = 0; i < count; ++i) boxes[i] = box_of(corners + i, boxes_side_by_side, vertex_boxes);
    eight.set_all(boxes);
  });
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    const auto& below = levels_[l - 1];
    in_chunks(count_of(levels_[l]), [&](Index group) {
      const std::size_t first = at(group) * boxes_side_by_side;
      const std::size_t count = std::min(boxes_side_by_side, below.size() - first);
      if (count == boxes_side_by_side) {
        std::array<FloatBox, boxes_side_by_side> boxes;
        for (std::size_t i = 0; i < count; ++i) boxes[i] = below[first + i].hull();
        return levels_[l][at(group)].set_all(boxes);
      }
      for (std::size_t i = 0; i < count; ++i) levels_[l][at(group)].set(i, below[first + i].hull());
    });
  }
  return !has_spread();
}

bool BoxTree::has_spread() {
  least_spread_.resize(levels_.size(), std::numeric_limits<double>::infinity());
  const double item_sides = sum_of_sides(levels_[0]) / static_cast<double>(item_count_);
  bool has_grown = false;
  for (std::size_t l = 1; l < levels_.size() && levels_[l - 1].size() >= boxes_side_by_side; ++l) {
    const double items = item_sides * static_cast<double>(levels_[l - 1].size());
    const double spread = std::max(0.0, sum_of_sides(levels_[l]) - items);
    least_spread_[l] = std::min(least_spread_[l], spread);
    has_grown |= spread > most_spread * least_spread_[l] + unnoticed_spread * items;
  }
  return has_grown;
}

}  // namespace pliant::collision
