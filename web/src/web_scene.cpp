#include "web_scene.h"

#include <algorithm>
#include <array>

#include "pliant/collision/crossings.h"
#include "pliant/constraints/drag.h"
#include "pliant/constraints/position.h"
#include "pliant/core/error.h"

namespace pliant_web {

WebScene::WebScene(const std::string& text, const std::string& name) : scene_(pliant::parse_scene(text, "", name)) {}

std::vector<pliant::Triangle> WebScene::triangles() const {
  std::vector<pliant::Triangle> all;
  for (const pliant::Body& body : scene_.simulation.bodies()) {
    for (pliant::Triangle triangle : surface_triangles(body.mesh)) {
      for (Index& corner : triangle) corner += body.first_vertex;
      all.push_back(triangle);
    }
  }
  return all;
}

pliant::BodyId WebScene::body_of(Index vertex) const {
  const std::vector<pliant::Body>& bodies = scene_.simulation.bodies();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Index of_body = vertex - bodies[i].first_vertex;
    if (of_body >= 0 && of_body < bodies[i].mesh.vertex_count()) return pliant::BodyId{static_cast<Index>(i)};
  }
  pliant::fail_input("vertex " + std::to_string(vertex) + " is out of range; the scene has " +
                     std::to_string(positions().rows()));
}

void WebScene::grab(Index vertex, Real stiffness, const Vec3& target) {
  const pliant::BodyId body = body_of(vertex);
  const std::array stencil{vertex - scene_.simulation.body(body).first_vertex};
  pliant::Drag drag;
  drag.stencils.add(std::span<const Index>(stencil));
  drag.stiffness = stiffness;
  drag.targets = pliant::Points(target);
  const pliant::GroupId added = scene_.simulation.add(body, drag, "pull");
  let_go();
  spring_ = added;
}

void WebScene::pull_to(const Vec3& target) {
  if (spring_) scene_.simulation.set_target(*spring_, 0, target);
}

void WebScene::let_go() {
  if (spring_) scene_.simulation.remove(*spring_);
  spring_.reset();
}

void WebScene::pin(Index vertex) {
  if (pins_.contains(vertex)) return;
  const pliant::BodyId body = body_of(vertex);
  pliant::Position position;
  position.on = pliant::Selection({vertex - scene_.simulation.body(body).first_vertex});
  pins_[vertex] = scene_.simulation.add(body, position, "pin " + std::to_string(vertex));
}

void WebScene::move_pin(Index vertex, const Vec3& target) {
  const auto found = pins_.find(vertex);
  if (found == pins_.end()) pliant::fail_input("vertex " + std::to_string(vertex) + " has no pin; pin it first");
  scene_.simulation.set_target(found->second, 0, target);
}

void WebScene::unpin(Index vertex) {
  const auto found = pins_.find(vertex);
  if (found == pins_.end()) return;
  scene_.simulation.remove(found->second);
  pins_.erase(found);
}

void WebScene::set(const std::string& owner, const std::string& option, const Vec3& value) {
  for (const pliant::Parameter& each : parameters()) {
    if (each.name != owner || each.handle.option != option) continue;
    set_parameter(scene_.simulation, each.handle, value);
    return;
  }
  const std::string place = owner.empty() ? "settings" : owner;
  pliant::fail_input("there is no option '" + option + "' of '" + place + "'; parameters() lists all there are");
}

}  // namespace pliant_web
