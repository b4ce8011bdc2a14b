#include "pliant/collision/pairs/common_motion.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "pliant/collision/detail/box_search.h"
#include "pliant/core/svd.h"

namespace pliant {
namespace {

constexpr Real infinite = std::numeric_limits<Real>::infinity();
/// Of r: pinned bodies none of whose vertices goes so far are left to planes.
constexpr Real short_way = 0.5;
/// Of the ways of pinned vertices: what a rigid motion may leave of them.
constexpr Real most_left_of_pins = 0.5;
/// Of all ways of a cluster: what must not be left of them.
constexpr Real most_left = 0.9;
/// In units of rounding: pairs that are nearer might change sides.
constexpr Real sure_units = 64;
/// For visit_overlaps(), past which things are taken to meet.
constexpr std::int64_t most_effort = 20'000'000;

bool has_moved(const CommonMotions::Input& input, Index v) {
  return (input.begin.row(v).array() != input.end.row(v).array()).any();
}

Real way_of(const CommonMotions::Input& input, Index v) {
  return (input.end.row(v) - input.begin.row(v)).norm();
}

Real left_of(const CommonMotions::Input& input, const RigidMove& move, Index v) {
  return (row(input.end, v) - move(row(input.begin, v))).norm();
}

/// Nearest in Σ w ‖·‖². A little of no turn at all decides where the vertices leave one open.
RigidMove fit_weighted(std::span<const Index> vertices, std::span<const Real> weights, const Positions& begin,
                       const Positions& end) {
  constexpr Real share_of_rest = 1e-9;
  RigidMove move;
  Real sum = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    sum += weights[i];
    move.from += weights[i] * row(begin, vertices[i]);
    move.to += weights[i] * row(end, vertices[i]);
  }
  move.from /= sum;
  move.to /= sum;
  Mat3 moments = Mat3::Zero();
  Real size = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3 a = row(begin, vertices[i]) - move.from;
    moments += weights[i] * (row(end, vertices[i]) - move.to) * a.transpose();
    size += weights[i] * a.squaredNorm();
  }
  if (!(size > 0)) return move;
  const SmallSvd<3> parts = signed_svd(moments + share_of_rest * size * Mat3::Identity());
  move.turn = parts.U * parts.V.transpose();
  return move;
}

}  // namespace

RigidMove RigidMove::fit(std::span<const Index> vertices, const Positions& begin, const Positions& end) {
  constexpr int rounds = 12;
  constexpr Real least_share = 1e-4;  // of the mean way, below which what is left counts alike
  std::vector<Real> weights(vertices.size(), 1);
  Real sum = 0;
  for (const Index v : vertices) sum += (end.row(v) - begin.row(v)).norm();
  const Real least = least_share * sum / static_cast<Real>(vertices.size());
  RigidMove move = fit_weighted(vertices, weights, begin, end);
  for (int i = 0; i < rounds && least > 0; ++i) {
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const Index v = vertices[k];
      weights[k] = 1 / std::max(least, (row(end, v) - move(row(begin, v))).norm());
    }
    move = fit_weighted(vertices, weights, begin, end);
  }
  return move;
}

void CommonMotions::set_surface(const Surface& surface) {
  surface_ = &surface;
  parts_.assign(surface.meets_itself.size(), {});
  for (const Index v : surface.vertices) parts_[at(surface.body[at(v)])].vertices.push_back(v);
}

bool CommonMotions::may_help(const Input& input) {
  for (Part& part : parts_) {
    part.pinned.clear();
    part.rests = part.leads = false;
  }
  for (const Index v : input.pinned) parts_[at(surface_->body[at(v)])].pinned.push_back(v);
  bool is_any = false;
  for (Part& part : parts_) {
    if (part.pinned.empty()) continue;
    const auto moving = std::ranges::count_if(part.pinned, [&](Index v) { return has_moved(input, v); });
    part.rests = 2 * moving <= static_cast<std::ptrdiff_t>(part.pinned.size());
    const auto goes_far = [&](Index v) { return way_of(input, v) > short_way * input.radii[at(v)]; };
    if (part.rests || std::ranges::none_of(part.pinned, goes_far)) continue;
    const RigidMove move = RigidMove::fit(part.pinned, input.begin, input.end);
    Real ways = 0, left = 0;
    for (const Index v : part.pinned) {
      ways += way_of(input, v);
      left += left_of(input, move, v);
    }
    part.leads = left < most_left_of_pins * ways;
    is_any |= part.leads;
  }
  return is_any;
}

Index CommonMotions::root_of(Index part) {
  while (root_[at(part)] != part) part = root_[at(part)] = root_[at(root_[at(part)])];
  return part;
}

/// Which parts go together, and which may not go at all.
void CommonMotions::join(const Input& input, std::span<const PairList::Near> near) {
  root_.resize(parts_.size());
  std::iota(root_.begin(), root_.end(), 0);
  std::vector<char> is_blocked(parts_.size(), 0);
  for (const PairList::Near& each : near) {
    const auto& vertices = each.pair.vertices;
    const Index a = surface_->body[at(vertices[0])];
    const Index b = surface_->body[at(vertices[static_cast<std::size_t>(each.pair.first_side())])];
    Real size = 0;
    for (const Index v : vertices) {
      size = std::max({size, input.begin.row(v).cwiseAbs().maxCoeff(), input.end.row(v).cwiseAbs().maxCoeff()});
    }
    const bool is_too_near = !(each.distance > sure_units * std::numeric_limits<Real>::epsilon() * size);
    const bool meets_rest = a != b && (parts_[at(a)].rests || parts_[at(b)].rests);
    if (is_too_near || meets_rest) is_blocked[at(a)] = is_blocked[at(b)] = 1;
    if (a != b && !meets_rest) root_[at(std::max(root_of(a), root_of(b)))] = std::min(root_of(a), root_of(b));
  }
  is_blocked_.assign(parts_.size(), 0);
  for (Index i = 0; i < count_of(parts_); ++i) {
    if (is_blocked[at(i)] != 0 || parts_[at(i)].rests) is_blocked_[at(root_of(i))] = 1;
  }
}

bool CommonMotions::is_worth(const Input& input, const Cluster& cluster) const {
  Real ways = 0, left = 0;
  for (const Index part : cluster.parts) {
    for (const Index v : parts_[at(part)].vertices) {
      ways += way_of(input, v);
      left += left_of(input, cluster.move, v);
    }
  }
  return left < most_left * ways;
}

bool CommonMotions::find(const Input& input, std::span<const PairList::Near> near, Positions& start) {
  join(input, near);
  clusters_.clear();
  cluster_of_.assign(parts_.size(), -1);
  std::vector<Index> number(parts_.size(), -1);
  for (Index i = 0; i < count_of(parts_); ++i) {
    if (parts_[at(i)].leads && is_blocked_[at(root_of(i))] == 0) number[at(root_of(i))] = 0;
  }
  for (Index i = 0; i < count_of(parts_); ++i) {
    Index& cluster = number[at(root_of(i))];
    if (cluster < 0) continue;
    if (root_of(i) == i) {
      cluster = count_of(clusters_);
      clusters_.emplace_back();
    }
    clusters_[at(cluster)].parts.push_back(i);
  }
  std::vector<Index> pinned;
  bool is_any = false;
  for (Index c = 0; c < count_of(clusters_); ++c) {
    Cluster& cluster = clusters_[at(c)];
    pinned.clear();
    for (const Index part : cluster.parts) {
      pinned.insert(pinned.end(), parts_[at(part)].pinned.begin(), parts_[at(part)].pinned.end());
    }
    cluster.move = RigidMove::fit(pinned, input.begin, input.end);
    if (!is_worth(input, cluster)) continue;
    is_any = true;
    for (const Index part : cluster.parts) {
      cluster_of_[at(part)] = c;
      for (const Index v : parts_[at(part)].vertices) start.row(v) = cluster.move(row(input.begin, v)).transpose();
    }
  }
  while (is_any && drop_those_that_meet(input, start)) {
    for (Index i = 0; i < count_of(parts_); ++i) {
      if (cluster_of_[at(i)] >= 0) continue;
      for (const Index v : parts_[at(i)].vertices) start.row(v) = input.begin.row(v);
    }
    is_any = std::ranges::any_of(cluster_of_, [](Index c) { return c >= 0; });
  }
  return is_any;
}

/// Around where a feature is on its way.
struct CommonMotions::SweptBox {
  collision::Box box{Vec3::Constant(infinite), Vec3::Constant(-infinite)};
  bool is_pinned = true;
  Index part = 0;

  void add(const SweptBox& other) {
    box.low = box.low.cwiseMin(other.box.low);
    box.high = box.high.cwiseMax(other.box.high);
    is_pinned = is_pinned && other.is_pinned;
  }
};

/// An arc of an angle θ at a distance ρ lies within ρ θ²/8 of its chord.
CommonMotions::SweptBox CommonMotions::box_of(const Input& input, const Positions& start,
                                              std::span<const Index> corners) const {
  SweptBox swept;
  swept.part = surface_->body[at(corners[0])];
  const Index cluster = cluster_of_[at(swept.part)];
  Real angle = 0;
  if (cluster >= 0) angle = Eigen::AngleAxis<Real>(clusters_[at(cluster)].move.turn).angle();
  for (const Index v : corners) {
    Real pad = input.radii[at(v)];
    if (angle > 0) pad += angle * angle / 8 * (row(input.begin, v) - clusters_[at(cluster)].move.from).norm();
    swept.box.low = swept.box.low.cwiseMin(row(input.begin, v).cwiseMin(row(start, v)) - Vec3::Constant(pad));
    swept.box.high = swept.box.high.cwiseMax(row(input.begin, v).cwiseMax(row(start, v)) + Vec3::Constant(pad));
    swept.is_pinned = swept.is_pinned && input.is_pinned[at(v)] != 0;
  }
  return swept;
}

/// Clusters stay that would meet what does not go with them. Returns whether there are any.
bool CommonMotions::drop_those_that_meet(const Input& input, const Positions& start) {
  std::vector<SweptBox> whole(parts_.size());
  for (Index i = 0; i < count_of(parts_); ++i) {
    for (const Index v : parts_[at(i)].vertices) whole[at(i)].add(box_of(input, start, std::array{v}));
  }
  std::vector<char> is_asked(parts_.size(), 0);
  bool is_any = false;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    for (std::size_t j = i + 1; j < parts_.size(); ++j) {
      if (cluster_of_[i] == cluster_of_[j] || (whole[i].is_pinned && whole[j].is_pinned)) continue;
      if (!whole[i].box.overlaps(whole[j].box)) continue;
      is_asked[i] = is_asked[j] = 1;
      is_any = true;
    }
  }
  if (!is_any) return false;
  std::vector<SweptBox> features;
  std::vector<collision::Box> going, staying;
  std::vector<Index> going_features, staying_features;
  const auto add = [&](std::span<const Index> corners) {
    const Index part = surface_->body[at(corners[0])];
    if (is_asked[at(part)] == 0) return;
    features.push_back(box_of(input, start, corners));
    if (cluster_of_[at(part)] >= 0) {
      going.push_back(features.back().box);
      going_features.push_back(count_of(features) - 1);
    }
    staying.push_back(features.back().box);
    staying_features.push_back(count_of(features) - 1);
  };
  for (const Triangle& each : surface_->triangles) add(each);
  for (std::size_t e = at(surface_->loose_begin); e < surface_->edges.size(); ++e) add(surface_->edges[e]);
  std::vector<char> meets(clusters_.size(), 0);
  const bool is_all = collision::visit_overlaps(going, staying, most_effort, [&](Index a, Index b) {
    const SweptBox& first = features[at(going_features[at(a)])];
    const SweptBox& second = features[at(staying_features[at(b)])];
    const Index mine = cluster_of_[at(first.part)];
    if (mine == cluster_of_[at(second.part)] || (first.is_pinned && second.is_pinned)) return;
    meets[at(mine)] = 1;
  });
  bool is_dropped = false;
  for (Index& cluster : cluster_of_) {
    if (cluster < 0 || (is_all && meets[at(cluster)] == 0)) continue;
    cluster = -1;
    is_dropped = true;
  }
  return is_dropped;
}

}  // namespace pliant
