#pragma once
// A session of a scene with something of everything, and changes of every kind, for tests of what becomes of these.
#include <algorithm>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "viewer/session.h"

namespace pliant_tests {

using namespace pliant_viewer;

inline constexpr std::string_view sheet_text = R"({
  "pliant": 1,
  "settings": { "iterations": 10 },
  "bodies": [ {
    "name": "sheet",
    "mesh": { "shape": "grid", "columns": 9, "rows": 9, "size": [1, 1], "plane": "xz" },
    "mass": { "area_density": 0.3 },
    "constraints": [
      { "type": "position", "name": "hooks", "on": [72, 80] },
      { "type": "triangle_strain", "name": "stretch", "stiffness": 500 },
      { "type": "hinge", "name": "bend", "stiffness": 0.001 }
    ]
  }, {
    "name": "scarf",
    "mesh": { "shape": "grid", "columns": 6, "rows": 4, "size": [0.6, 0.4], "plane": "xz" },
    "transform": { "translate": [0, 1, 0] },
    "material": { "name": "silk", "direction": [1, 0, 0], "angle": 15 },
    "constraints": [ { "type": "position", "on": "corners" } ]
  } ],
  "forces": [ { "type": "wind", "velocity": [0, 0.5, 0], "drag": 1 } ],
  "colliders": [ { "type": "sphere", "name": "ball", "center": [0, 0.4, 0], "radius": 0.15, "velocity": [0, 0.1, 0] },
                 { "type": "capsule", "name": "bar", "from": [-1, 2, 0], "to": [1, 2, 0] } ],
  "moves": [ { "group": "hooks", "index": 1, "time": 0.2, "over": 1, "offset": [0.2, 0, 0] },
             { "group": "ball", "time": 0.3, "over": 0.5, "offset": [0, -0.6, 0] } ],
  "events": [ { "time": 0.25, "change": "bend", "stiffness": 0.01, "over": 0.3 } ]
})";

inline pliant::Scene make_scene() {
  return pliant::parse_scene(sheet_text, {}, "sheet");
}

inline const pliant::Positions& positions(const pliant::Simulation& simulation) {
  return simulation.state().positions;
}
inline const pliant::Positions& positions(const Session& session) {
  return positions(session.simulation());
}

inline void steps(Session& session, int count) {
  for (int i = 0; i < count; ++i) session.step();
}

inline double value(const Session& session, std::string_view key) {
  const std::vector<Slider> list = session.sliders();
  const auto found = std::ranges::find(list, key, &Slider::key);
  REQUIRE(found != list.end());
  return found->parameter.value[0];
}

inline Vec3f place(const Session& session, Index vertex) {
  return positions(session).row(vertex).transpose().cast<float>();
}

inline pliant::ColliderId collider(const Session& session, const char* name) {
  return session.simulation().find_collider(name).value();
}

/// One change of every kind; what is moved is moved before the first step.
inline void change_everything(Session& session) {
  const bool is_start = session.simulation().state().step == 0;
  session.set("settings.iterations", {14, 0, 0});
  session.set("contact.friction", {0.7, 0, 0});
  session.set("contact:scarf.distance", {0.013, 0, 0});
  session.set("group:bend.stiffness", {0.004, 0, 0});
  session.set("group:stretch.max_stretch", {1.03, 0, 0});
  session.set("group:scarf.bend.stiffness", {2e-5, 0, 0});
  session.set("force:gravity.acceleration", {0, 0.5, -8});
  session.set("force:wind.velocity", {0.3, 0.8, 0});
  session.set("collider:ball.radius", {0.2, 0, 0});
  session.pin(40);
  session.pin(90);
  session.unpin(72);
  if (is_start) {
    session.move_pin(90, place(session, 90) + Vec3f(0.02F, 0, 0.05F));
    session.drop_pin(90);
    session.move_pin(80, place(session, 80) + Vec3f(0, 0.1F, 0));
    session.drop_pin(80);
    for (const char* name : {"ball", "bar"}) {
      session.move_collider(collider(session, name), Vec3f(0.1F, 0.6F, 0.1F));
      session.drop_collider(collider(session, name));
    }
  }
}

}  // namespace pliant_tests
