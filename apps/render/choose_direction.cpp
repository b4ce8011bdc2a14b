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

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

/// A small picture that knows of each pixel how far away it is, and whose it is.
class DepthPicture {
 public:
  DepthPicture(const Viewpoint& view, float aspect)
      : width_(std::clamp(static_cast<int>(picture_height * aspect), 8, 8 * picture_height)),
        near_(view.near),
        projection_(view.projection(aspect) * view.view()),
        depths_(static_cast<std::size_t>(width_ * picture_height), std::numeric_limits<float>::infinity()),
        owners_(depths_.size(), nobody) {}

  void add_triangle(const Vec3f& a, const Vec3f& b, const Vec3f& c, std::uint32_t owner) {
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
        if (s >= 0 && t >= 0 && s + t <= 1) set(x, y, p[0].z() + s * u.z() + t * v.z(), owner);
      }
    }
  }

  void add_edge(const Vec3f& a, const Vec3f& b, std::uint32_t owner) {
    Vec3f from, to;
    if (!project(a, from) || !project(b, to)) return;
    const float length = (to - from).head<2>().cwiseAbs().maxCoeff();
    const int parts = std::clamp(static_cast<int>(length), 1, 2 * (width_ + picture_height));
    for (int i = 0; i <= parts; ++i) {
      const Vec3f p = from + static_cast<float>(i) / static_cast<float>(parts) * (to - from);
      const int x = first(p.x() - 0.5F), y = first(p.y() - 0.5F);
      if (x <= last(p.x() + 0.5F, width_) && y <= last(p.y() + 0.5F, picture_height)) set(x, y, p.z(), owner);
    }
  }

  /// Adds how many pixels each has.
  void count(std::vector<double>& pixels) const {
    for (const std::uint32_t owner : owners_) {
      if (owner != nobody) ++pixels[owner];
    }
  }

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
  void set(int x, int y, float depth, std::uint32_t owner) {
    const auto pixel = static_cast<std::size_t>(y * width_ + x);
    if (!(depth < depths_[pixel])) return;
    depths_[pixel] = depth;
    owners_[pixel] = owner;
  }

  int width_;
  float near_;
  Mat4f projection_;
  std::vector<float> depths_;
  std::vector<std::uint32_t> owners_;
};

void add_surfaces(DepthPicture& picture, const std::vector<DrawnCollider>& colliders) {
  for (const DrawnCollider& each : colliders) {
    const Mat4f place = matrix_of(each.pose);
    const auto moved = [&](const ColliderSurface::Corner& corner) -> Vec3f {
      return place.topLeftCorner<3, 3>() * corner.position + place.topRightCorner<3, 1>();
    };
    const std::vector<ColliderSurface::Corner>& corners = each.surface->corners;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
      picture.add_triangle(moved(corners[i]), moved(corners[i + 1]), moved(corners[i + 2]), nobody);
    }
  }
}

/// Adds the pixels in which each free body is seen.
void count_pixels(const RenderMesh& render_mesh, const FrameContent& frame, const Viewpoint& view, float aspect,
                  std::vector<double>& pixels) {
  const std::vector<Vec3f>& x = frame.positions;
  std::vector<std::uint32_t> owners = render_mesh.bodies;
  for (const std::uint32_t vertex : frame.held) owners[vertex] = nobody;
  DepthPicture picture(view, aspect);
  add_surfaces(picture, frame.colliders);
  const std::vector<std::uint32_t>& triangles = render_mesh.triangles;
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
    picture.add_triangle(x[triangles[i]], x[triangles[i + 1]], x[triangles[i + 2]], owners[triangles[i]]);
  }
  const std::vector<std::uint32_t>& ropes = render_mesh.ropes;
  for (std::size_t i = 0; i + 1 < ropes.size(); i += 2) {
    picture.add_edge(x[ropes[i]], x[ropes[i + 1]], owners[ropes[i]]);
  }
  picture.count(pixels);
}

/// Of each body as a share of what the direction that shows it best shows of it, all bodies together.
double share_seen(const std::vector<std::vector<double>>& seen, std::size_t direction) {
  double sum = 0;
  for (std::size_t body = 0; body < seen.front().size(); ++body) {
    double best = 0;
    for (const std::vector<double>& each : seen) best = std::max(best, each[body]);
    if (best > 0) sum += seen[direction][body] / best;
  }
  return sum;
}

}  // namespace

pliant::Camera choose_direction(pliant::Camera camera, const RenderMesh& render_mesh,
                                std::span<const FrameContent> frames, const Bounds& bounds, float aspect) {
  if (camera.position || camera.azimuth || camera.elevation || !camera.keyframes.empty()) return camera;
  const std::size_t bodies =
      render_mesh.bodies.empty() ? 0 : 1 + std::size_t{*std::ranges::max_element(render_mesh.bodies)};
  std::vector<std::vector<double>> seen;  // by each direction of each body
  for (const Direction& direction : directions) {
    camera.azimuth = direction.azimuth;
    camera.elevation = direction.elevation;
    const Viewpoint view = place_camera(camera, bounds, aspect);
    std::vector<double>& pixels = seen.emplace_back(bodies, 0);
    for (const FrameContent& frame : frames) count_pixels(render_mesh, frame, view, aspect, pixels);
    // The count of pixels falls with the square of the distance. Times the distance itself it favors neither a camera
    // that stands near, nor one that looks along a row of bodies from far away.
    const double distance = (view.eye - bounds.center()).norm();
    for (double& each : pixels) each *= distance;
  }
  std::size_t best = 0;
  double most = lead * share_seen(seen, 0);
  for (std::size_t i = 1; i < directions.size(); ++i) {
    if (const double share = share_seen(seen, i); share > most) {
      most = share;
      best = i;
    }
  }
  camera.azimuth = directions[best].azimuth;
  camera.elevation = directions[best].elevation;
  return camera;
}

}  // namespace pliant_render
