// Nothing passes a collider, however fast, and what falls on one comes to rest.
#include <doctest/doctest.h>

#include "contact_scenes.h"

namespace test_contact_impact {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// A collider about the origin, with its middle: what no straight way may cross.
struct Target {
  std::string name;
  std::function<ColliderId(Simulation&)> add;
  std::function<Real(const Vec3&)> distance;  // to its surface
  std::function<bool(const Vec3&, const Vec3&)> crosses_middle;
};

bool passes_near_origin(const Vec3& from, const Vec3& to, Real radius) {
  const Vec3 way = to - from;
  const Real share = std::clamp(-from.dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (from + share * way).norm() < radius;
}

std::vector<Target> targets() {
  const PlacedShape capsule = build(CapsuleCollider{.from = {0, -2, 0}, .to = {0, 2, 0}, .radius = 0.05});
  const PlacedShape box = build(BoxCollider{.size = {0.3, 0.3, 0.3}});
  return {{"plane", [](Simulation& s) { return s.add(PlaneCollider{}); }, [](const Vec3& x) { return x.z(); },
           [](const Vec3& a, const Vec3& b) { return (a.z() > 0) != (b.z() > 0); }},
          {"sphere", [](Simulation& s) { return s.add(SphereCollider{.radius = 0.2}); },
           [](const Vec3& x) { return x.norm() - 0.2; },
           [](const Vec3& a, const Vec3& b) { return passes_near_origin(a, b, 0.1); }},
          {"capsule",
           [](Simulation& s) {
             return s.add(CapsuleCollider{.from = {0, -2, 0}, .to = {0, 2, 0}, .radius = 0.05});
           },
           [capsule](const Vec3& x) { return capsule.shape->distance(capsule.pose.to_frame(x)).distance; },
           [](const Vec3& a, const Vec3& b) {  // from one side of the axis to the other, below it
             const Real share = a.z() / (a.z() - b.z());
             return a.z() > 0 && b.z() < 0 && std::abs(a.x() + share * (b.x() - a.x())) < 1e-3;
           }},
          {"box",
           [](Simulation& s) {
             return s.add(BoxCollider{.size = {0.3, 0.3, 0.3}});
           },
           [box](const Vec3& x) { return box.shape->distance(box.pose.to_frame(x)).distance; },
           [](const Vec3& a, const Vec3& b) { return passes_near_origin(a, b, 0.075); }}};
}

}  // namespace

TEST_CASE("impact: cloth at 30 m/s passes through nothing, at any time step") {
  for (const Target& target : targets()) {
    for (const Real time_step : {1.0 / 240, 1.0 / 60, 1.0 / 15}) {
      CAPTURE(target.name);
      CAPTURE(time_step);
      Simulation simulation({.time_step = time_step, .iterations = 10, .threads = 1});
      const BodyId sheet =
          add_sheet(simulation, {.vertices = 20, .velocity = {0, 0, -30}, .center = {0.01, 0.02, 0.8}}, Vec3::UnitZ());
      simulation.add(Gravity{});
      target.add(simulation);
      const Real distance = simulation.contact_distance(sheet);
      Real deepest = 0;
      int crossings = 0;
      Index contacts = 0;
      for (int i = 0; i < static_cast<int>(0.4 / time_step); ++i) {
        const Positions before = simulation.state().positions;
        contacts += simulation.step().contact.contacts;
        for (Index v = 0; v < before.rows(); ++v) {
          const Vec3 now = row(simulation.state().positions, v);
          deepest = std::max(deepest, -target.distance(now));
          crossings += target.crosses_middle(row(before, v), now) ? 1 : 0;
        }
      }
      CHECK(contacts > 0);
      CHECK(crossings == 0);
      CHECK(deepest < distance);
      CHECK(simulation.state().positions.allFinite());
    }
  }
}

TEST_CASE("impact: a ball that moves by its radius in a step takes cloth along in front of it") {
  Simulation simulation({.threads = 1});
  const BodyId sheet = add_sheet(simulation, {.vertices = 24}, Vec3::UnitZ());
  const ColliderId ball = simulation.add(SphereCollider{.center = {0, 0, -1}, .radius = 0.2, .velocity = {0, 0, 12}});
  const Real distance = simulation.contact_distance(sheet);
  for (int i = 0; i < 30; ++i) {
    simulation.step();
    const Vec3 center = simulation.pose(ball).position;
    Real nearest = 1;
    for (Index v = 0; v < simulation.state().vertex_count(); ++v) {
      nearest = std::min(nearest, (row(simulation.state().positions, v) - center).norm() - 0.2);
    }
    CHECK(nearest > 0.04 * distance);
  }
  CHECK(simulation.pose(ball).position.z() == doctest::Approx(5));
  CHECK(simulation.state().positions.col(2).maxCoeff() > 5.2);
}

TEST_CASE("impact: a block of 8.8 kg falls on a plane and a sphere, and lies still on the plane") {
  for (const bool on_sphere : {false, true}) {
    CAPTURE(on_sphere);
    Simulation simulation({.threads = 1});
    Mesh block = bar({.cells = {6, 6, 6}, .size = {0.2, 0.2, 0.2}});
    Simulation probe;
    const Real distance = probe.contact_distance(probe.add_body(block, Mass::density(1100)));
    block.vertices.rowwise() += Eigen::RowVector3d(-0.1, -0.1, 0.5 + distance);
    const BodyId body = simulation.add_body(std::move(block), Mass::density(1100));
    simulation.add(body, TetrahedronStrain{.stiffness = 1e5});
    simulation.add(Gravity{});
    if (on_sphere) {
      simulation.add(SphereCollider{.center = {0, 0, -0.3}, .radius = 0.3});
    } else {
      simulation.add(PlaneCollider{});
    }
    bool has_hit = false;
    Real deepest = 0;
    for (int i = 0; i < (on_sphere ? 60 : 180); ++i) {
      const StepReport report = simulation.step();
      for (const ContactPoint& each : simulation.contacts()) deepest = std::max(deepest, -each.distance);
      has_hit |= report.contact.contacts > 0;
    }
    CHECK(has_hit);
    CHECK(deepest < distance / 2);
    if (on_sphere) continue;
    CHECK(simulation.state().velocities.rowwise().norm().maxCoeff() < 1e-6);
    CHECK(simulation.contacts().size() == 49);
    Real weight = 0;
    for (const ContactPoint& each : simulation.contacts()) weight += each.force.z();
    CHECK(weight == doctest::Approx(8.8 * 9.81).epsilon(1e-3));
  }
}

TEST_CASE("impact: the objective never rises between refreshes of friction, but for what is counted") {
  Simulation simulation({.iterations = 20, .threads = 1});
  add_sheet(simulation, {.vertices = 20, .velocity = {0, 0, -2}, .center = {0.01, 0.02, 0.1}}, Vec3::UnitZ());
  simulation.add(Gravity{});
  simulation.add(SphereCollider{.center = {0, 0, -0.3}, .radius = 0.3});
  Index contacts = 0;
  for (int i = 0; i < 60; ++i) {
    const StepReport report = simulation.step();
    contacts += report.contact.contacts;
    const std::span<const Real> objective = simulation.objective_history();
    Index rises = 0;
    for (std::size_t k = 1; k < objective.size(); ++k) {
      const bool is_refresh = k == 6 || k == 16;
      if (!is_refresh && objective[k] > objective[k - 1] * (1 + 1e-12)) ++rises;
    }
    CHECK(rises <= report.contact.held_back);
  }
  CHECK(contacts > 1000);
}

}  // namespace test_contact_impact
