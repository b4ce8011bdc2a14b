#include "pliant/mesh/shapes/curve.h"

#include <array>
#include <cmath>

namespace pliant {

namespace {

/// The spline at u of the way from b to c; a and d are the points before and behind (Barry and Goldman's pyramid).
Vec3 on_spline(const std::array<Vec3, 4>& p, Real u) {
  std::array<Real, 4> t{};
  for (std::size_t i = 1; i < 4; ++i) t[i] = t[i - 1] + std::sqrt((p[i] - p[i - 1]).norm());
  const Real now = t[1] + u * (t[2] - t[1]);
  const auto mix = [&](const Vec3& x, const Vec3& y, std::size_t i, std::size_t j) -> Vec3 {
    return ((t[j] - now) * x + (now - t[i]) * y) / (t[j] - t[i]);
  };
  const Vec3 ab = mix(p[0], p[1], 0, 1), bc = mix(p[1], p[2], 1, 2), cd = mix(p[2], p[3], 2, 3);
  return mix(mix(ab, bc, 0, 2), mix(bc, cd, 1, 3), 1, 2);
}

}  // namespace

std::vector<Vec3> smooth_curve(const std::vector<Vec3>& points, CurveEnds ends) {
  const bool is_joined = ends == CurveEnds::joined;
  constexpr int parts = 64;
  const std::size_t n = points.size();
  const std::size_t spans = is_joined ? n : n - 1;
  const auto before = [&](std::size_t i) -> Vec3 {
    return is_joined || i > 0 ? points[(i + n - 1) % n] : Vec3(2 * points[0] - points[1]);
  };
  const auto behind = [&](std::size_t i) -> Vec3 {
    return is_joined || i + 2 < n ? points[(i + 2) % n] : Vec3(2 * points[n - 1] - points[n - 2]);
  };
  std::vector<Vec3> curve;
  curve.reserve(spans * parts + 1);
  for (std::size_t i = 0; i < spans; ++i) {
    const std::array<Vec3, 4> four{before(i), points[i], points[(i + 1) % n], behind(i)};
    for (int k = 0; k < parts; ++k) curve.push_back(on_spline(four, Real{1} * k / parts));
  }
  curve.push_back(points[is_joined ? 0 : n - 1]);
  return curve;
}

std::vector<Real> lengths_along(const std::vector<Vec3>& line) {
  std::vector<Real> lengths{0};
  for (std::size_t i = 1; i < line.size(); ++i) lengths.push_back(lengths.back() + (line[i] - line[i - 1]).norm());
  return lengths;
}

}  // namespace pliant
