#include "pliant/constraints/product_projection.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace pliant {
namespace {

/// A function and its slope at one place.
struct Value {
  Real value, slope;
};

/// A zero of f between lower and upper, where f(lower) ≤ 0 ≤ f(upper): Newton's method from `x`, halving where it
/// leaves the bracket or hardly gets on. Ends after a fixed number of steps, whatever f is.
template <class Function>
Real zero_between(Real lower, Real upper, Real x, const Function& f) {
  Real last = upper - lower;
  for (int i = 0; i < 200; ++i) {
    const Value at = f(x);
    (at.value <= 0 ? lower : upper) = x;
    Real next = x - at.value / at.slope;
    const bool gets_on = next >= lower && next <= upper && std::abs(next - x) <= last / 2;
    if (!gets_on) next = lower + (upper - lower) / 2;
    last = std::abs(next - x);
    if (!(last > std::numeric_limits<Real>::epsilon() / 2 * std::abs(next))) return next;
    x = next;
  }
  return x;
}

/// The root g ≥ 0 of g (σ − g) = −ν, ν ≥ 0, without cancellation.
Real enlarged(Real sigma, Real nu) {
  const Real root = std::sqrt(sigma * sigma + 4 * nu);
  return sigma > 0 ? (sigma + root) / 2 : 2 * nu / (root - sigma);
}

/// Where the product of σ is too small. All g grow with ν = −μ, so there is one such point, and it is the nearest.
Vec3 enlarge(const Vec3& sigma, Real product) {
  const Real side = std::cbrt(product);
  Real upper = side * (side - sigma[2]);  // all g are at least `side` there
  if (sigma[1] > 0) {
    const Real least = product / sigma[0] / sigma[1];  // so is g₃, and g₁ ≥ σ₁, g₂ ≥ σ₂
    upper = std::min(upper, least * (least - sigma[2]));
  }
  const auto excess = [&](Real nu) -> Value {
    const Vec3 g = sigma.unaryExpr([nu](Real s) { return enlarged(s, nu); });
    Real relative = 0;
    for (int i = 0; i < 3; ++i) relative += 1 / (g[i] * std::sqrt(sigma[i] * sigma[i] + 4 * nu));
    const Real all = g[2] * g[0] * g[1];
    return {all - product, all * relative};
  };
  const bool is_near = sigma.prod() > product / 8;
  const Real nu = zero_between(0, upper, is_near ? 0 : upper, excess);
  return sigma.unaryExpr([nu](Real s) { return enlarged(s, nu); });
}

/// Where the product of σ is too large, all σ > 0: the points with g₃ = x, 0 < x ≤ σ₃, and g₁, g₂ the larger roots of
/// g (σ − g) = μ = x (σ₃ − x). In no other point is the distance least: a smaller root has negative curvature, of which
/// a minimum under one condition has at most one, and sorted stretches have it last.
class Reduction {
 public:
  Reduction(const Vec3& sigma, Real product) : sigma_(sigma), product_(product) {}

  Vec3 at(Real x) const {
    const Real r = sigma_[2] - 2 * x;
    const auto larger = [&](Real s) { return (s + std::sqrt((s - sigma_[2]) * (s + sigma_[2]) + r * r)) / 2; };
    return {larger(sigma_[0]), larger(sigma_[1]), x};
  }
  Value excess(Real x) const {
    const Vec3 g = at(x);
    const Real r = sigma_[2] - 2 * x;
    Real relative = 1 / x;
    for (int i = 0; i < 2; ++i) {
      const Real root = 2 * g[i] - sigma_[i];
      relative -= (root > 0 ? r / root : 1) / g[i];
    }
    const Real all = g[2] * g[0] * g[1];
    return {all - product_, all * relative};
  }

  /// The nearest of the points with the product.
  Vec3 nearest() {
    const Real half = sigma_[2] / 2;
    const auto f = [this](Real x) { return excess(x); };
    if (excess(half).value <= 0) consider(zero_between(half, 2 * half, 2 * half, f));
    // Where g₃ ≤ σ₃/2 the distance is at least as much.
    if (best_distance_ <= half) return best_;
    constexpr int samples = 32;
    Real before = 0;
    bool is_below = true;
    for (int i = 1; i <= samples; ++i) {
      const Real rest = 1 - static_cast<Real>(i) / samples;
      const Real x = half * (1 - rest * rest);
      const bool is_above = excess(x).value > 0;
      if (is_below && is_above) consider(zero_between(before, x, x, f));
      before = x;
      is_below = !is_above;
    }
    return best_;
  }

 private:
  void consider(Real x) {
    const Vec3 g = at(x);
    const Real distance = (g - sigma_).norm();
    if (!(distance < best_distance_)) return;
    best_distance_ = distance;
    best_ = g;
  }

  Vec3 sigma_;
  Real product_;
  Vec3 best_ = Vec3::Ones();
  Real best_distance_ = std::numeric_limits<Real>::infinity();
};

}  // namespace

// With u = (g₁ + g₂)/√2, v = (g₁ − g₂)/√2, a and b the same of σ: u² = 2 t + v², and the distance is least where
// h(v) = 2 v − b − a v/u = 0. h is convex with h(0) ≤ 0, so from the right Newton's method goes down to the one place
// where it becomes positive.
Vec2 nearest_of_product(const Vec2& sigma, Real product) {
  const Real a = (sigma[0] + sigma[1]) * std::numbers::sqrt2 / 2;
  const Real b = (sigma[0] - sigma[1]) * std::numbers::sqrt2 / 2;
  const auto u_of = [product](Real v) { return std::hypot(v, std::sqrt(2 * product)); };
  const auto h = [&](Real v) -> Value {
    const Real u = u_of(v);
    return {2 * v - b - a * (v / u), 2 - a / u * (2 * product / u / u)};
  };
  Real v = (a + b) / 2;
  const Value near = h(b);
  if (near.slope > 0) v = std::min(v, b - near.value / near.slope);
  for (int i = 0; i < 100; ++i) {
    const Value at = h(v);
    const Real next = v - at.value / at.slope;
    if (!(next < v)) break;
    v = std::max(next, Real(0));
  }
  const Real larger = (u_of(v) + v) * std::numbers::sqrt2 / 2;
  return {larger, product / larger};
}

Vec3 nearest_of_product(const Vec3& sigma, Real product) {
  const Real given = sigma[2] * sigma[0] * sigma[1];
  Vec3 g = given < product ? enlarge(sigma, product) : Reduction(sigma, product).nearest();
  g[2] = product / g[0] / g[1];
  return g;
}

}  // namespace pliant
