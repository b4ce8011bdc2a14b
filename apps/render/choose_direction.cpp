#include "render/choose_direction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace pliant_render {
namespace {

struct Direction {
  pliant::Real azimuth, elevation;  // [degrees]
};
// The first is taken unless another shows so much more.
constexpr std::array<Direction, 8> directions = {
    {{24.2, 21}, {-24.2, 21}, {65.8, 21}, {-65.8, 21}, {24.2, 38}, {-24.2, 38}, {65.8, 38}, {-65.8, 38}}};
constexpr double lead = 1.1;
constexpr int picture_height = 120;  // [pixels], enough to compare

/// A small picture that knows of each pixel how far away it is, and whether it is counted.
class DepthPicture {
 public:
  DepthPicture(const Viewpoint& view, float aspect)
      : width_(std::clamp(static_cast<int>(picture_height * aspect), 8, 8 * picture_height)),
        near_(view.near),
        projection_(view.projection(aspect) * view.view()),
        depths_(static_cast<std::size_t>(width_ * picture_height), std::numeric_limits<float>::infinity()),
        is_counted_(depths_.size(), 0) {}

  void add_triangle(const Vec3f& a, const Vec3f& b, const Vec3f& c, bool counts) {
    std::array<Vec3f, 3> p;
    if (!project(a, p[0]) || !project(b, p[1]) || !project(c, p[2])) return;
    const Vec3f u = p[1] - p[0], v = p[2] - p[0];
    const float area = u.x() * v.y() - u.y() * v.x();
    if (!(std::abs(area) > 0)) return;
    const auto [left, right] = std::minmax({p[0].x(), p[1].x(), p[2].x()});
    const auto [low, high] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
    for (int y = first(low); y <= last(high, picture_height); ++y) {
      for (int x = first(left); x <= last(right, width_); ++x) {
        const float dx = static_cast<float>(x) - p[0].x(), dy = static_cast<float>(y) - p[0].y();
        const float s = (dx * v.y() - dy * v.x()) / area, t = (u.x() * dy - u.y() * dx) / area;
        if (s >= 0 && t >= 0 && s + t <= 1) set(x, y, p[0].z() + s * u.z() + t * v.z(), counts);
      }
    }
  }

  void add_edge(const Vec3f& a, const Vec3f& b) {
    Vec3f from, to;
    if (!project(a, from) || !project(b, to)) return;
    const float length = (to - from).head<2>().cwiseAbs().maxCoeff();
    const int parts = std::clamp(static_cast<int>(length), 1, 2 * (width_ + picture_height));
    for (int i = 0; i <= parts; ++i) {
      const Vec3f p = from + static_cast<float>(i) / static_cast<float>(parts) * (to - from);
      const int x = first(p.x() - 0.5F), y = first(p.y() - 0.5F);
      if (x <= last(p.x() + 0.5F, width_) && y <= last(p.y() + 0.5F, picture_height)) set(x, y, p.z(), true);
    }
  }

  std::ptrdiff_t count() const { return std::ranges::count(is_counted_, 1); }

 private:
  /// To pixels and the depth; false where it is not before the camera.
  bool project(const Vec3f& point, Vec3f& result) const {
    const Eigen::Vector4f clip = projection_ * point.homogeneous();
    if (!(clip.w() > near_) || !clip.allFinite()) return false;
    const Vec3f p = clip.head<3>() / clip.w();
    result = {(p.x() + 1) / 2 * static_cast<float>(width_), (p.y() + 1) / 2 * picture_height, p.z()};
    return true;
  }
  static int first(float low) { return static_cast<int>(std::ceil(std::clamp(low, 0.0F, 1e4F))); }
  static int last(float high, int size) {
    return static_cast<int>(std::floor(std::clamp(high, -1.0F, static_cast<float>(size - 1))));
  }
  void set(int x, int y, float depth, bool counts) {
    const auto pixel = static_cast<std::size_t>(y * width_ + x);
    if (!(depth < depths_[pixel])) return;
    depths_[pixel] = depth;
    is_counted_[pixel] = counts ? 1 : 0;
  }

  int width_;
  float near_;
  Mat4f projection_;
  std::vector<float> depths_;
  std::vector<std::uint8_t> is_counted_;
};

void add_surfaces(DepthPicture& picture, const std::vector<DrawnCollider>& colliders) {
  for (const DrawnCollider& each : colliders) {
    const Mat4f place = matrix_of(each.pose);
    const auto moved = [&](const ColliderSurface::Corner& corner) -> Vec3f {
      return place.topLeftCorner<3, 3>() * corner.position + place.topRightCorner<3, 1>();
    };
    const std::vector<ColliderSurface::Corner>& corners = each.surface->corners;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
      picture.add_triangle(moved(corners[i]), moved(corners[i + 1]), moved(corners[i + 2]), false);
    }
  }
}

/// Pixels in which free bodies are seen.
std::ptrdiff_t pixels_of(const RenderMesh& render_mesh, const FrameContent& frame, const Viewpoint& view,
                         float aspect) {
  const std::vector<Vec3f>& x = frame.positions;
  std::vector<char> is_held(x.size(), 0);
  for (const std::uint32_t vertex : frame.held) is_held[vertex] = 1;
  DepthPicture picture(view, aspect);
  add_surfaces(picture, frame.colliders);
  const std::vector<std::uint32_t>& triangles = render_mesh.triangles;
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
    picture.add_triangle(x[triangles[i]], x[triangles[i + 1]], x[triangles[i + 2]], is_held[triangles[i]] == 0);
  }
  const std::vector<std::uint32_t>& ropes = render_mesh.ropes;
  for (std::size_t i = 0; i + 1 < ropes.size(); i += 2) picture.add_edge(x[ropes[i]], x[ropes[i + 1]]);
  return picture.count();
}

}  // namespace

pliant::Camera choose_direction(pliant::Camera camera, const RenderMesh& render_mesh,
                                std::span<const FrameContent> frames, const Bounds& bounds, float aspect, float inset) {
  if (camera.position || camera.azimuth || camera.elevation || !camera.keyframes.empty()) return camera;
  double most = 0;
  Direction best = directions[0];
  for (std::size_t i = 0; i < directions.size(); ++i) {
    camera.azimuth = directions[i].azimuth;
    camera.elevation = directions[i].elevation;
    const Viewpoint view = place_camera(camera, bounds, aspect, inset);
    // Between pixels, which a camera nearby has more of, and the area seen, which one from the end of a row has more
    // of.
    const double size_of_pixel = (view.eye - bounds.center()).norm();
    double seen = 0;
    for (const FrameContent& frame : frames) {
      seen += size_of_pixel * static_cast<double>(pixels_of(render_mesh, frame, view, aspect));
    }
    if (i == 0) seen *= lead;
    if (seen > most) {
      most = seen;
      best = directions[i];
    }
  }
  camera.azimuth = best.azimuth;
  camera.elevation = best.elevation;
  return camera;
}

}  // namespace pliant_render
