#pragma once
// Draws the colliders of a frame: solid surfaces, and planes with a shadow on them.
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "pliant_io/scene/view_settings.h"
#include "render/collider_view.h"
#include "render/floor_shadow.h"
#include "render/scene_light.h"
#include "render/surface_programs.h"

namespace pliant_render {

/// How points become places in the picture.
struct Projection {
  Mat4f camera;
  float setback;  ///< in the depths of OpenGL: colliders give way to what touches them
};

class ColliderPainter {
 public:
  /// Needs a current OpenGL context, as do all members.
  ColliderPainter();

  void set_frame(const std::vector<DrawnCollider>& colliders);
  /// Planes that are seen from their front, floors first.
  struct SeenPlane {
    Mat4f place;                ///< from its frame to space
    std::optional<Vec3f> tone;  ///< of its own
  };
  std::vector<SeenPlane> planes(const Vec3f& eye, const ColliderLooks& looks = {}) const;
  bool has_planes() const;
  /// Of those that are not planes, in space [m].
  void each_point(const std::function<void(const Vec3f&)>& take) const;
  /// What casts shadows, in space.
  Bounds bounds_in(const Mat4f& frame, const Vec3f& light) const;

  /// Draws the triangles of all solids with a program that takes the place of each as its uniform `place`.
  void draw_triangles(const Program& program, const Mat4f& frame) const;
  /// `lit`: the numbers of those that are drawn brighter.
  void draw_solids(const Projection& projection, const SceneLight& light, const ColliderLooks& looks,
                   const std::array<std::optional<pliant::Index>, 2>& lit);
  /// A plane that fades from the middle of the scene outward; texture 0 is the mask of its shadow.
  struct PlaneLook {
    Vec3f middle;  ///< of the scene [m]
    float extent;  ///< where it has faded [m]
    Vec3f background;
    float darkness;    ///< of the shadow
    bool is_last;      ///< only the background is behind it
    Vec2f picture;     ///< size [pixels]
    PictureArea dark;  ///< where shadows and bodies may keep light from it
  };
  void draw_plane(const SeenPlane& plane, const PlaneLook& look, const ShadowArea& shadow, const Projection& projection,
                  const Vec3f& to_light, const SceneLight& light) const;

 private:
  void draw_triangles_of(const DrawnCollider& each, const Program& program, const Mat4f& frame) const;

  struct Solid {
    std::shared_ptr<const ColliderSurface> surface;
    VertexArray array;
    Buffer corners;
  };

  std::vector<DrawnCollider> colliders_;
  std::map<const ColliderSurface*, std::unique_ptr<Solid>> solids_;
  SurfacePrograms programs_;
  Program bright_plane_, plane_, dark_plane_;  // in all light, where a shadow may lie, and where less sky is seen too
  VertexArray empty_array_;
};

/// A point of space on a floor, z = 0 in its frame, along the light; what is below the floor stays where it is.
Vec3f flatten(const Vec3f& point_in_frame, const Vec3f& light_in_frame);

}  // namespace pliant_render
