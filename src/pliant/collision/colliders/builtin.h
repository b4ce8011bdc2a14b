#pragma once
// The list of built-in colliders: scene files, their schema, the tables of the docs, the sliders and every other
// interface are written over it. A new collider is its pair of files, and here its include and its place in the list.
#include <tuple>

#include "pliant/collision/colliders/box.h"
#include "pliant/collision/colliders/capsule.h"
#include "pliant/collision/colliders/plane.h"
#include "pliant/collision/colliders/sphere.h"

namespace pliant {

using BuiltinColliders = std::tuple<PlaneCollider, SphereCollider, CapsuleCollider, BoxCollider>;

}  // namespace pliant
