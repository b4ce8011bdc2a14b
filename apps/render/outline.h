#pragma once
// What has to fit into the picture: the points of all frames that lie furthest out.
#include <span>
#include <vector>

#include "render/render_mesh.h"

namespace pliant_render {

/// Collects the box around frames and, in a hundred directions, the point that is furthest: the hull of these misses at
/// most 4 % of the radius of a ball, less than the margin of a picture.
class Outline {
 public:
  Outline();

  /// Bodies, and colliders where they are shown, see collider_points.
  void add(const FrameContent& frame, const pliant::ViewSettings& appearance);
  /// Around everything so far, with its outline.
  Bounds bounds() const;

 private:
  void add(std::span<const Vec3f> points, const Bounds& box);

  Bounds box_;
  std::vector<Vec3f> directions_;
  std::vector<float> reach_;     // of the furthest point in each direction [m]
  std::vector<Vec3f> furthest_;  // that point
};

}  // namespace pliant_render
