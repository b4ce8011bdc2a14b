#pragma once
// What is drawn of colliders: the surface of each shape, made once, and where it is in a frame.
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pliant/simulation/simulation.h"
#include "pliant_io/scene/body_appearance.h"
#include "render/camera.h"

namespace pliant_render {

/// Of what goes where it is told: colliders, and bodies that are held as a whole.
inline const Vec3f solid_tone(0.60F, 0.65F, 0.71F);

/// What a collider looks like.
struct ColliderLook {
  Vec3f tone = solid_tone;                        ///< shares of red, green and blue, 0 to 1 (sRGB)
  bool is_own = false;                            ///< or that of all
  pliant::Finish finish = pliant::Finish::matte;  ///< never `automatic`

  bool operator==(const ColliderLook&) const = default;
};
using ColliderLooks = std::map<std::string, ColliderLook, std::less<>>;  ///< by name
ColliderLook collider_look(const pliant::ColliderAppearance& appearance);

/// The surface of a shape, in its own frame.
struct ColliderSurface {
  struct Corner {
    Vec3f position;  ///< [m]
    Vec3f normal;    ///< of length 1
  };
  std::shared_ptr<const pliant::ColliderShape> shape;
  std::vector<Corner> corners;  ///< three for each triangle; none of a plane
  std::vector<Vec3f> points;    ///< its vertices, that the shadow reaches and the camera sees [m]; none of a plane
  bool is_plane = false;        ///< z = 0 in its frame, without end, seen from above
};

struct DrawnCollider {
  pliant::Index number = 0;  ///< of its ColliderId
  std::string name{};
  std::shared_ptr<const ColliderSurface> surface;
  pliant::Pose pose{};
};

/// From the frame of a collider to space.
Mat4f matrix_of(const pliant::Pose& pose);

/// Makes the surface of a shape when it is first asked for. Shapes that are not drawn any longer are let go.
class ColliderSurfaces {
 public:
  /// All colliders that have a surface, by number.
  std::vector<DrawnCollider> find(const pliant::Simulation& simulation);

 private:
  std::map<const pliant::ColliderShape*, std::shared_ptr<const ColliderSurface>> surfaces_;
};

/// What the camera should see of colliders beside bodies in a box: all of each, but for what has no end, and what is so
/// large beside the bodies that they would be lost in the picture.
std::vector<Vec3f> collider_points(const std::vector<DrawnCollider>& colliders, const Bounds& bodies);

/// The height of the highest plane whose normal is up [m]; none where there is none.
std::optional<float> floor_height(const std::vector<DrawnCollider>& colliders);

}  // namespace pliant_render
