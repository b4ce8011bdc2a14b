#pragma once
// What is done to a session by hand, one of these each time.
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "pliant/core/types.h"
#include "pliant_io/scene/body_appearance.h"
#include "viewer/picking.h"
#include "viewer/rigid_motion.h"

namespace pliant_viewer {

using pliant::Index;
using pliant::Real;

/// The spring between the mouse and a point of a body.
struct Pull {
  SurfacePoint point;
  Vec3f target = {0, 0, 0};  ///< [m]
  Real stiffness = 1;        ///< [N/m]
};

/// What a brush leaves of a stiffness.
struct PaintDab {
  std::vector<Index> vertices{};  ///< in the simulation, of one body
  std::vector<Real> shares{};     ///< of the way to the factor, by ratios, 0 to 1, of each
  Real factor = 1;                ///< that the stiffness is to be multiplied by, 0.001 to 1000
};

/// A group whose stiffness can be painted, and its body.
struct PaintableGroup {
  std::string group;
  std::string body;
};

/// A stroke of paint under way.
struct PaintStroke {
  std::string group{};
  std::vector<Real> before{};  ///< the factors when it began
  std::vector<Real> shares{};  ///< the largest so far, by vertex of the body
};

/// Each is called like the member of Session that does it, and has what that is given.
namespace action {
struct Grab {
  Pull pull;
};
struct PullTo {
  Vec3f target = {0, 0, 0};  ///< [m]
};
struct PullStiffness {
  Real stiffness = 1;  ///< [N/m]
};
struct LetGo {};
struct PinVertex {
  Index vertex = 0;
};
struct Unpin {
  Index vertex = 0;
};
struct MovePin {
  Index vertex = 0;
  Vec3f target = {0, 0, 0};  ///< [m]
};
struct DropPin {
  Index vertex = 0;
};
struct MoveCollider {
  Index collider = 0;
  Vec3f target = {0, 0, 0};  ///< [m]
};
struct TurnCollider {
  Index collider = 0;
  pliant::Vec3 rotation = pliant::Vec3::Zero();  ///< axis times angle [rad]
};
struct DropCollider {
  Index collider = 0;
};
struct Set {
  std::string key;
  pliant::Vec3 value = pliant::Vec3::Zero();
  bool goes_on = false;
};
struct SetMaterial {
  std::string body, material;
};
struct SetAppearance {
  std::string body;
  pliant::BodyAppearance appearance;
  bool goes_on = false;
};
struct SwitchOn {
  std::string name;
  bool on = true;
};
struct Add {
  std::string type, body;
};
struct Push {
  std::vector<Index> vertices;
};
struct Paint {
  std::string group;
  PaintDab dab;
  bool goes_on = false;
};
struct Undo {};
struct Redo {};
struct Restart {
  bool keep_changes = true;
};
struct Save {};
struct PinVertices {
  std::vector<Index> vertices;
};
struct UnpinVertices {
  std::vector<Index> vertices;
};
struct HoldPins {
  std::vector<Index> vertices;
};
struct MoveHeld {
  RigidMotion motion;
};
struct DropHeld {};
}  // namespace action

using Action =
    std::variant<action::Grab, action::PullTo, action::PullStiffness, action::LetGo, action::PinVertex, action::Unpin,
                 action::MovePin, action::DropPin, action::MoveCollider, action::DropCollider, action::Set,
                 action::SetMaterial, action::Undo, action::Redo, action::Restart, action::Save, action::PinVertices,
                 action::UnpinVertices, action::HoldPins, action::MoveHeld, action::DropHeld, action::SetAppearance,
                 action::SwitchOn, action::Add, action::Push, action::Paint, action::TurnCollider>;

/// An action, and how many steps the session had taken before it.
struct TimedAction {
  std::int64_t step = 0;
  Action action;
};

/// The bits of positions and velocities after so many steps.
struct StepChecksum {
  std::int64_t step = 0;
  std::uint32_t crc32 = 0;
};

}  // namespace pliant_viewer
