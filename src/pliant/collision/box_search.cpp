#include "pliant/collision/detail/box_search.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace pliant::collision {

namespace {

/// Few enough to try each with each.
constexpr std::size_t few_boxes = 8;
constexpr std::int64_t effort_of_visit = 32;

class BoxSearch {
 public:
  BoxSearch(std::span<const Box> queries, std::span<const Box> boxes, std::int64_t effort,
            const std::function<void(Index, Index)>& visit)
      : queries_(queries), boxes_(boxes), effort_left_(effort), visit_(visit) {}

  bool is_complete() const { return effort_left_ >= 0; }

  /// `chosen` are indices of boxes, which are put into another order; `candidates` are queries that overlap their hull.
  void descend(std::span<Index> chosen, const std::vector<Index>& candidates) {
    if (candidates.empty() || chosen.empty() || !is_complete()) return;
    if (chosen.size() <= few_boxes) return try_all(chosen, candidates);
    const auto middle = static_cast<std::ptrdiff_t>(chosen.size() / 2);
    const Eigen::Index axis = longest_axis(chosen);
    std::ranges::nth_element(chosen, chosen.begin() + middle, [&](Index a, Index b) {
      const Real place_a = middle_of(a, axis);
      const Real place_b = middle_of(b, axis);
      return place_a != place_b ? place_a < place_b : a < b;
    });
    for (const std::span<Index> half : {chosen.first(chosen.size() / 2), chosen.subspan(chosen.size() / 2)}) {
      descend(half, overlapping(candidates, hull(half)));
    }
  }

 private:
  Real middle_of(Index box, Eigen::Index axis) const {
    return boxes_[at(box)].low[axis] / 2 + boxes_[at(box)].high[axis] / 2;
  }

  Box hull(std::span<const Index> chosen) const {
    Box result = boxes_[at(chosen.front())];
    for (const Index box : chosen) {
      result.low = result.low.cwiseMin(boxes_[at(box)].low);
      result.high = result.high.cwiseMax(boxes_[at(box)].high);
    }
    return result;
  }

  /// Along which the middles of the boxes lie farthest apart.
  Eigen::Index longest_axis(std::span<const Index> chosen) const {
    const auto middle = [&](Index box) -> Vec3 { return boxes_[at(box)].low / 2 + boxes_[at(box)].high / 2; };
    Vec3 low = middle(chosen.front());
    Vec3 high = low;
    for (const Index box : chosen) {
      low = low.cwiseMin(middle(box));
      high = high.cwiseMax(middle(box));
    }
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    return axis;
  }

  std::vector<Index> overlapping(const std::vector<Index>& candidates, const Box& box) {
    std::vector<Index> result;
    effort_left_ -= static_cast<std::int64_t>(candidates.size());
    for (const Index query : candidates) {
      if (queries_[at(query)].overlaps(box)) result.push_back(query);
    }
    return result;
  }

  void try_all(std::span<const Index> chosen, const std::vector<Index>& candidates) {
    for (const Index query : candidates) {
      if (!is_complete()) return;
      effort_left_ -= static_cast<std::int64_t>(chosen.size());
      for (const Index box : chosen) {
        if (!queries_[at(query)].overlaps(boxes_[at(box)])) continue;
        effort_left_ -= effort_of_visit;
        visit_(query, box);
      }
    }
  }

  std::span<const Box> queries_;
  std::span<const Box> boxes_;
  std::int64_t effort_left_;
  const std::function<void(Index, Index)>& visit_;
};

}  // namespace

bool visit_overlaps(std::span<const Box> queries, std::span<const Box> boxes, std::int64_t most,
                    const std::function<void(Index query, Index box)>& visit) {
  std::vector<Index> chosen(boxes.size());
  std::iota(chosen.begin(), chosen.end(), 0);
  std::vector<Index> candidates(queries.size());
  std::iota(candidates.begin(), candidates.end(), 0);
  BoxSearch search(queries, boxes, most, visit);
  search.descend(chosen, candidates);
  return search.is_complete();
}

}  // namespace pliant::collision
