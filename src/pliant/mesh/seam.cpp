#include "pliant/mesh/seam.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace pliant {
namespace {

/// Of so many vertices at most the distances are looked at in finding how two loops meet.
constexpr std::size_t most_samples = 512;
/// Turns of a loop that are tried at first, and halvings of the best one's surroundings.
constexpr int turns_tried = 1024;
constexpr int halvings = 40;
/// Of an edge: nearer to a vertex than that is at the vertex.
constexpr Real at_vertex = 1e-9;

Chain reversed(Chain chain) {
  std::ranges::reverse(chain.vertices);
  return chain;
}

/// Half of the edges at each vertex [m].
std::vector<Real> tributary_lengths(const Chain& chain, const Positions& x) {
  const std::vector<Real> along = lengths_along(chain, x);
  const std::size_t count = chain.vertices.size();
  std::vector<Real> lengths(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const Real half = (along[i + 1] - along[i]) / 2;  // 0 behind an open end
    lengths[i] += half;
    lengths[(i + 1) % count] += half;
  }
  return lengths;
}

// ---- vertex by vertex

struct Turn {
  std::size_t turn = 0;
  Real sum = std::numeric_limits<Real>::infinity();
};

Turn best_turn(const Chain& from, const Positions& x_from, const Chain& to, const Positions& x_to) {
  const std::size_t count = from.vertices.size();
  const std::size_t stride = count / most_samples + 1;
  Turn best;
  for (std::size_t turn = 0; turn < (to.is_closed ? count : 1); ++turn) {
    Real sum = 0;
    for (std::size_t i = 0; i < count; i += stride) {
      sum += (row(x_from, from.vertices[i]) - row(x_to, to.vertices[(i + turn) % count])).squaredNorm();
    }
    if (sum < best.sum) best = {turn, sum};
  }
  return best;
}

// ---- by length

/// Points of a chain by their share of its length.
class Course {
 public:
  Course(const Chain& chain, const Positions& x) : chain_(chain), x_(x), along_(lengths_along(chain, x)) {}

  Real length() const { return along_.back(); }
  /// share: of the length, from 0 to 1, of a loop any. From the last vertex of an open chain nothing leads on.
  Stitch at_share(Real share) const {
    const std::size_t count = chain_.vertices.size();
    const std::size_t edges = chain_.is_closed ? count : count - 1;
    if (chain_.is_closed) share -= std::floor(share);
    const Real place = share * length();
    const auto next = std::upper_bound(along_.begin() + 1, along_.begin() + static_cast<std::ptrdiff_t>(edges), place);
    const auto e = static_cast<std::size_t>(next - along_.begin()) - 1;
    const Real size = along_[e + 1] - along_[e];
    const Real t = size > 0 ? std::clamp<Real>((place - along_[e]) / size, 0, 1) : 0;
    const Index a = chain_.vertices[e], b = chain_.vertices[(e + 1) % count];
    if (t < at_vertex) return {-1, a, a, 0, 0};
    if (t > 1 - at_vertex) return {-1, b, b, 0, 0};
    return {-1, a, b, t, 0};
  }
  Vec3 point(Real share) const {
    const Stitch stitch = at_share(share);
    return (1 - stitch.share) * row(x_, stitch.a) + stitch.share * row(x_, stitch.b);
  }

 private:
  const Chain& chain_;
  const Positions& x_;
  std::vector<Real> along_;
};

/// How far `to` is turned against `from`, as a share of its length, and the sum of squared distances then.
struct ShareTurn {
  Real share = 0;
  Real sum = std::numeric_limits<Real>::infinity();
};

ShareTurn best_share(const Chain& from, const Positions& x_from, const std::vector<Real>& along, const Course& course) {
  const std::size_t stride = from.vertices.size() / most_samples + 1;
  const auto try_turn = [&](Real turn) {
    ShareTurn tried{turn, 0};
    for (std::size_t i = 0; i < from.vertices.size(); i += stride) {
      tried.sum += (row(x_from, from.vertices[i]) - course.point(along[i] / along.back() + turn)).squaredNorm();
    }
    return tried;
  };
  ShareTurn best = try_turn(0);
  if (!from.is_closed) return best;
  for (int k = 1; k < turns_tried; ++k) {
    const ShareTurn tried = try_turn(static_cast<Real>(k) / turns_tried);
    if (tried.sum < best.sum) best = tried;
  }
  Real step = Real{1} / turns_tried;
  for (int i = 0; i < halvings; ++i, step /= 2) {
    for (const Real turn : {best.share - step / 2, best.share + step / 2}) {
      const ShareTurn tried = try_turn(turn);
      if (tried.sum < best.sum) best = tried;
    }
  }
  return best;
}

/// Whether the second chain is to be turned round.
bool goes_back(Real sum, Real sum_reversed, SeamDirection direction) {
  return (sum_reversed < sum) == (direction == SeamDirection::nearest);
}

}  // namespace

std::vector<Stitch> stitch_in_order(const Chain& from, const Positions& x_from, const Chain& to, const Positions& x_to,
                                    SeamDirection direction) {
  const Chain back = reversed(to);
  const Turn forward_turn = best_turn(from, x_from, to, x_to);
  const Turn back_turn = best_turn(from, x_from, back, x_to);
  const bool is_back = goes_back(forward_turn.sum, back_turn.sum, direction);
  const Chain& second = is_back ? back : to;
  const std::size_t turn = is_back ? back_turn.turn : forward_turn.turn;
  const std::vector<Real> of_from = tributary_lengths(from, x_from), of_to = tributary_lengths(second, x_to);
  std::vector<Stitch> stitches;
  for (std::size_t i = 0; i < from.vertices.size(); ++i) {
    const std::size_t j = (i + turn) % from.vertices.size();
    stitches.push_back({from.vertices[i], second.vertices[j], second.vertices[j], 0, (of_from[i] + of_to[j]) / 2});
  }
  return stitches;
}

std::vector<Stitch> stitch_by_length(const Chain& from, const Positions& x_from, const Chain& to, const Positions& x_to,
                                     SeamDirection direction) {
  const Chain back = reversed(to);
  const Course forward_course(to, x_to), back_course(back, x_to);
  const std::vector<Real> along = lengths_along(from, x_from);
  const ShareTurn forward_turn = best_share(from, x_from, along, forward_course);
  const ShareTurn back_turn = best_share(from, x_from, along, back_course);
  const bool is_back = goes_back(forward_turn.sum, back_turn.sum, direction);
  const Course& course = is_back ? back_course : forward_course;
  const Real turn = is_back ? back_turn.share : forward_turn.share;
  const std::vector<Real> lengths = tributary_lengths(from, x_from);
  std::vector<Stitch> stitches;
  for (std::size_t i = 0; i < from.vertices.size(); ++i) {
    Stitch stitch = course.at_share(along[i] / along.back() + turn);
    stitch.vertex = from.vertices[i];
    stitch.length = lengths[i];
    stitches.push_back(stitch);
  }
  return stitches;
}

}  // namespace pliant
