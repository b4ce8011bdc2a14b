#include "viewer/added_parts.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "pliant/collision/colliders/builtin.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant/forces/builtin.h"
#include "viewer/json_of.h"

namespace pliant_viewer {
namespace {

template <class... Types>
void list_forces(std::tuple<Types...>*, std::vector<AddableType>& list) {
  const auto add = [&](const pliant::ForceInfo& info) {
    if (!info.required.empty() || info.name == pliant::Gravity::info.name) return;
    list.push_back({"forces", info.name, info.reach == pliant::ForceReach::body});
  };
  (add(Types::info), ...);
}

template <class... Types>
void list_colliders(std::tuple<Types...>*, std::vector<AddableType>& list) {
  (list.push_back({"colliders", Types::info.name, false}), ...);
}

/// With three digits of the size that it is to have.
Real rounded(Real number, Real size) {
  const Real unit = std::pow(Real{10}, std::floor(std::log10(size)) - 2);
  return std::round(number / unit) * unit;
}

/// Where a collider stands, so that bodies fall onto it and none is inside it.
Json place_beneath(const std::string& type, const pliant::BoundingBox& bodies, Real floor) {
  const pliant::Vec3 middle = (bodies.min + bodies.max) / 2;
  const Real longest = (bodies.max - bodies.min).maxCoeff();
  const Real size = std::isfinite(longest) && longest > 0 ? longest : 1;
  const auto number = [size](Real value) { return rounded(value, size); };
  const bool is_above = bodies.min.z() - size / 2 < floor;
  const auto point = [&](Real x, Real away) {
    const Real z = is_above ? bodies.max.z() + away : bodies.min.z() - away;
    return Json{number(middle.x() + x), number(middle.y()), number(z)};
  };
  const Real gap = 0.05 * size, radius = number(0.2 * size), thin = number(0.05 * size), half = number(0.4 * size);
  if (type == pliant::SphereCollider::info.name) return {{"center", point(0, gap + radius)}, {"radius", radius}};
  if (type == pliant::BoxCollider::info.name) {
    return {{"center", point(0, gap + radius)}, {"size", {2 * radius, 2 * radius, 2 * radius}}};
  }
  if (type == pliant::CapsuleCollider::info.name) {
    return {{"from", point(-half, gap + thin)}, {"to", point(half, gap + thin)}, {"radius", thin}};
  }
  if (type == pliant::PlaneCollider::info.name) {
    return {{"position", Json{number(middle.x()), number(middle.y()), number(bodies.min.z() - gap)}}};
  }
  return Json::object();
}

}  // namespace

std::vector<AddableType> addable_types() {
  std::vector<AddableType> list;
  list_forces(static_cast<pliant::BuiltinForces*>(nullptr), list);
  list_colliders(static_cast<pliant::BuiltinColliders*>(nullptr), list);
  return list;
}

bool can_hold_pressure(const pliant::Mesh& mesh) {
  try {
    return pliant::PressureForce(mesh, 0, {}).rest_volume() > 0;
  } catch (const pliant::Error&) {
    return false;
  }
}

AddedPart make_part(const std::string& type, const std::string& name, const std::string& body,
                    const pliant::BoundingBox& bodies, Real floor) {
  const std::vector<AddableType> types = addable_types();
  const auto found = std::ranges::find(types, type, &AddableType::name);
  if (found == types.end()) pliant::fail_input("there is no '" + pliant::printable(type) + "' to be added");
  if (found->is_of_body && body.empty()) {
    pliant::fail_input("'" + type + "' acts on one body; name it");
  }
  Json entry = {{"type", type}, {"name", name}};
  if (found->is_of_body) entry["body"] = body;
  if (found->list == "colliders") entry.update(place_beneath(type, bodies, floor));
  return {std::string(found->list), entry.dump()};
}

AddedPart make_push(const std::string& name, const std::string& body, const std::vector<Index>& vertices,
                    const pliant::Vec3& force) {
  const std::string_view type = pliant::TestForce::info.name;
  const Json entry = {
      {"type", type}, {"name", name}, {"body", body}, {"vertices", vertices}, {"force", json_of(force)}};
  return {"forces", entry.dump()};
}

}  // namespace pliant_viewer
