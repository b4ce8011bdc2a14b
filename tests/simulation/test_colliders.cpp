// Colliders in a simulation: what they feel, how they change while it runs, and what a state holds of them.
#include <cstring>
#include <limits>

#include <doctest/doctest.h>

#include "pliant/pliant.h"
#include "pliant/simulation/parameters.h"
#include "pliant/simulation/transaction.h"

namespace test_simulation_colliders {

using namespace pliant;

namespace {

/// A cloth above a ball, a box, a capsule and a floor, of which some move.
Simulation drape(const SolverSettings& settings, Index vertices = 20) {
  Simulation simulation(settings);
  Mesh mesh = grid({.columns = vertices, .rows = vertices, .plane = Plane::xy});
  mesh.vertices.rowwise() += Eigen::RowVector3d(-0.48, -0.51, 0.25);
  const BodyId cloth = simulation.add_body(std::move(mesh), Mass::area_density(0.2));
  simulation.add(cloth, TriangleStrain{.stiffness = 1e3});
  simulation.add(cloth, Bending{.stiffness = 1e-5});
  simulation.add(Gravity{});
  simulation.add(SphereCollider{.radius = 0.2, .angular_velocity = {0, 0, 3}}, "ball");
  simulation.add(BoxCollider{.center = {0.4, 0, 0.1}, .size = {0.2, 0.2, 0.2}, .rounding = 0.02}, "box");
  simulation.add(CapsuleCollider{.from = {-0.4, -0.4, 0.05}, .to = {-0.4, 0.4, 0.05}, .radius = 0.05}, "pole");
  simulation.add(PlaneCollider{.position = {0, 0, -0.2}}, "floor");
  return simulation;
}

void advance_by(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) simulation.step();
}

bool same_state(const Simulation& a, const Simulation& b) {
  const auto same = [](const Positions& x, const Positions& y) {
    return x.rows() == y.rows() &&
           std::memcmp(x.data(), y.data(), static_cast<std::size_t>(x.size()) * sizeof(Real)) == 0;
  };
  return same(a.state().positions, b.state().positions) && same(a.state().velocities, b.state().velocities);
}

std::string refusal(auto&& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("colliders: what they feel is what the bodies feel, the other way round") {
  Simulation simulation = drape({.threads = 1});
  for (int i = 0; i < 60; ++i) {
    simulation.step();
    Vec3 on_bodies = Vec3::Zero(), torque_on_bodies = Vec3::Zero();
    for (const ContactPoint& each : simulation.contacts()) {
      on_bodies += each.force;
      torque_on_bodies += row(simulation.state().positions, each.vertex).cross(each.force);
    }
    Vec3 on_colliders = Vec3::Zero(), torque_on_colliders = Vec3::Zero();
    for (const auto& [id, record] : simulation.colliders()) {
      const Wrench wrench = simulation.wrench(id);
      on_colliders += wrench.force;
      torque_on_colliders += wrench.torque + simulation.pose(id).position.cross(wrench.force);
    }
    const Real size = 1 + on_bodies.norm();
    CHECK((on_bodies + on_colliders).norm() < 1e-12 * size);
    CHECK((torque_on_bodies + torque_on_colliders).norm() < 1e-12 * size);
  }
  CHECK(simulation.contacts().size() > 20);
  Real pressed = 0, rubbed = 0;
  for (const ContactPoint& each : simulation.contacts()) {
    CHECK(each.normal.norm() == doctest::Approx(1));
    CHECK(each.force.dot(each.normal) >= 0);
    pressed += each.normal.dot(each.force);
    rubbed += (each.force - each.normal * each.normal.dot(each.force)).norm();
  }
  CHECK(rubbed > 0.01 * pressed);
  CHECK(rubbed < 1.05 * 0.3 * pressed);  // μ = .3; each goes by its load at the last refresh
}

TEST_CASE("colliders: the bits are the same for any number of threads") {
  Simulation one = drape({.threads = 1}, 60);
  advance_by(one, 40);
  for (const Index threads : {2, 3, 8}) {
    Simulation several = drape({.threads = threads}, 60);
    advance_by(several, 40);
    CAPTURE(threads);
    CHECK(same_state(one, several));
  }
}

TEST_CASE("colliders: a state taken up goes on with the same bits, at every tenth step") {
  for (const SolverSettings& settings :
       {SolverSettings{.threads = 1}, SolverSettings{.integrator = Integrator::bdf2, .threads = 1},
        SolverSettings{.substeps = 3, .iterations = 4, .threads = 1}}) {
    Simulation whole = drape(settings);
    for (int tenth = 0; tenth < 6; ++tenth) {
      Simulation resumed = drape(settings);
      resumed.restore(whole.state());
      advance_by(whole, 10);
      advance_by(resumed, 10);
      CHECK(same_state(whole, resumed));
    }
  }
}

TEST_CASE("colliders: a heavy body that puts contact into the factor is taken up with the same bits as well") {
  const auto make = [] {
    Simulation simulation({.threads = 1});
    Mesh block = bar({.cells = {10, 10, 10}, .size = {0.2, 0.2, 0.2}});
    block.vertices.rowwise() += Eigen::RowVector3d(-0.1, -0.1, 0.5);
    const BodyId body = simulation.add_body(std::move(block), Mass::density(1100));
    simulation.add(body, TetrahedronStrain{.stiffness = 1e6});
    simulation.add(Gravity{});
    simulation.add(PlaneCollider{});
    return simulation;
  };
  Simulation whole = make();
  Index refactorizations = 0;
  for (int i = 0; i < 4; ++i) {
    Simulation resumed = make();
    resumed.restore(whole.state());
    for (int k = 0; k < 10; ++k) refactorizations += whole.step().contact.refactorizations;
    advance_by(resumed, 10);
    CHECK(same_state(whole, resumed));
  }
  CHECK(refactorizations > 0);
}

TEST_CASE("contact: colliders alone are touched until it is set, surfaces from then on") {
  Simulation simulation = drape({.threads = 1});
  CHECK(simulation.contact() == ContactSettings{.surfaces = false});
  simulation.set_contact({.friction = 0.5});
  CHECK(simulation.contact() == ContactSettings{.friction = 0.5, .surfaces = true});
  simulation.step();
  CHECK(simulation.state().contact.let_go.is_known);  // what crosses has been looked for
  simulation.set_contact({.surfaces = false});
  CHECK(simulation.contact() == ContactSettings{.surfaces = false});
}

TEST_CASE("colliders: they come, change, move and go, and a transaction takes all of it back") {
  Simulation simulation = drape({.threads = 1});
  advance_by(simulation, 30);
  Simulation untouched = drape({.threads = 1});
  advance_by(untouched, 30);
  const ColliderId ball = simulation.find_collider("ball").value();
  {
    Transaction transaction(simulation);
    simulation.remove(simulation.find_collider("floor").value());
    simulation.add(SphereCollider{.center = {0, 0, 1}}, "another");
    simulation.replace(ball, SphereCollider{.center = {0, 0, 0.3}, .radius = 0.1});
    simulation.set_target(simulation.find_collider("box").value(), {{1, 1, 1}});
    simulation.set_contact({.distance = 0.02, .friction = 0.9});
  }
  CHECK(simulation.colliders().size() == 4);
  CHECK(simulation.find_collider("floor").has_value());
  CHECK(simulation.options<SphereCollider>(ball)->radius == 0.2);
  CHECK(simulation.contact() == ContactSettings{.surfaces = false});
  advance_by(simulation, 10);
  advance_by(untouched, 10);
  CHECK(same_state(simulation, untouched));

  simulation.set_target(ball, {{0, 0, 0.1}});
  simulation.step();
  CHECK(simulation.pose(ball).position == Vec3(0, 0, 0.1));
  simulation.step();
  CHECK(simulation.pose(ball).position == Vec3(0, 0, 0.1));
  for (const char* name : {"ball", "box", "pole", "floor"}) simulation.remove(simulation.find_collider(name).value());
  simulation.step();
  CHECK(simulation.contacts().empty());
  CHECK(simulation.state().contact.memory.empty());
}

TEST_CASE("colliders: after an edit, what was felt in the last step stays, and an evaluation knows no old collider") {
  Simulation simulation = drape({.threads = 1});
  advance_by(simulation, 40);
  const Real with_contact = simulation.evaluate().contact;
  CHECK(with_contact > 0);
  const ColliderId ball = simulation.find_collider("ball").value();
  simulation.set_target(ball, {{0, 0, 0.01}});
  simulation.step();
  const Wrench felt = simulation.wrench(ball);
  CHECK(felt.force.norm() > 0.1);
  simulation.set_contact({.friction = 0.1, .surfaces = false});
  CHECK(simulation.evaluate().contact == 0);
  CHECK(simulation.wrench(ball).force == felt.force);
  CHECK(simulation.wrench(ball).torque == felt.torque);
  simulation.step();
  CHECK(simulation.evaluate().contact > 0);
  simulation.add(BodyId{0}, Position{.on = {2, 3}});  // which stands beside the layout
  CHECK(simulation.evaluate().contact > 0);
  simulation.add(BodyId{0}, Line{.on = {0, 1}, .direction = Vec3(1, 0, 0)});  // another order of the vertices
  CHECK(simulation.evaluate().contact == 0);
  CHECK(simulation.evaluate().contact == 0);
  simulation.remove(simulation.find_collider("floor").value());
  simulation.remove(simulation.find_collider("box").value());
  CHECK(simulation.evaluate().contact == 0);
  simulation.step();
  CHECK(simulation.evaluate().contact > 0);
}

TEST_CASE("colliders: one that appears around a body lets it out, without a bang") {
  for (const Real radius : {0.8, 3.0}) {
    Simulation simulation = drape({.threads = 1});
    advance_by(simulation, 10);
    simulation.add(SphereCollider{.radius = radius}, "bubble");
    for (int i = 0; i < 30; ++i) {
      simulation.step();
      REQUIRE(simulation.state().positions.allFinite());
      CHECK(simulation.state().velocities.rowwise().norm().maxCoeff() < 20);
    }
  }
}

TEST_CASE("colliders: hostile values end in an error of one line or in finite numbers") {
  constexpr Real inf = std::numeric_limits<Real>::infinity();
  Simulation simulation = drape({.threads = 1}, 6);
  const auto refuses = [&](const auto& options) {
    const std::string message = refusal([&] { simulation.add(options); });
    return !message.empty() && message.find('\n') == std::string::npos;
  };
  CHECK(refuses(SphereCollider{.radius = 0}));
  CHECK(refuses(SphereCollider{.radius = -1}));
  CHECK(refuses(SphereCollider{.radius = std::nan("")}));
  CHECK(refuses(SphereCollider{.center = {inf, 0, 0}}));
  CHECK(refuses(SphereCollider{.friction = -1}));
  CHECK(refuses(CapsuleCollider{.radius = -1}));
  CHECK_FALSE(refusal([&] { simulation.set_contact({.distance = -1}); }).empty());
  CHECK_FALSE(refusal([&] { simulation.set_contact({.friction = std::nan("")}); }).empty());
  const ColliderId ball = simulation.find_collider("ball").value();
  CHECK_FALSE(refusal([&] { simulation.set_target(ball, {{inf, 0, 0}}); }).empty());
  CHECK_FALSE(refusal([&] { simulation.add_collider(nullptr, {}); }).empty());

  const auto stays_finite = [](auto&& change) {
    Simulation other = drape({.threads = 1}, 6);
    advance_by(other, 20);
    change(other);
    try {
      advance_by(other, 20);
    } catch (const Error& error) {
      return std::string_view(error.what()).find('\n') == std::string_view::npos;
    }
    return other.state().positions.allFinite() && other.state().velocities.allFinite();
  };
  CHECK(stays_finite([](Simulation& s) { s.add(SphereCollider{.radius = 1e300}); }));
  CHECK(stays_finite([](Simulation& s) { s.add(SphereCollider{.radius = 1e-300}); }));
  CHECK(stays_finite([](Simulation& s) { s.add(SphereCollider{.center = {0, 0, -3}, .velocity = {0, 0, 1e6}}); }));
  CHECK(stays_finite([](Simulation& s) { s.add(PlaneCollider{.velocity = {0, 0, 1e6}}); }));
  CHECK(stays_finite([](Simulation& s) { s.add(PlaneCollider{.angular_velocity = {1e6, 0, 0}}); }));
  CHECK(stays_finite([](Simulation& s) { s.add(PlaneCollider{.surface_velocity = {1e300, 0, 0}}); }));
  CHECK(stays_finite([](Simulation& s) { s.set_contact({.friction = 1e9, .surfaces = false}); }));
  CHECK(stays_finite([](Simulation& s) { s.set_contact({.distance = 10, .surfaces = false}); }));
  CHECK(stays_finite([](Simulation& s) { s.set_contact({.distance = 1e-12, .surfaces = false}); }));
}

TEST_CASE("colliders: energy projection is refused, from either side") {
  Simulation simulation = drape({.threads = 1}, 6);
  CHECK(refusal([&] { simulation.set_settings({.energy_projection = 1}); }).find("remove the colliders") !=
        std::string::npos);
  Simulation other({.energy_projection = 1});
  CHECK(refusal([&] { other.add(PlaneCollider{}); }).find("energy_projection") != std::string::npos);
  CHECK(other.colliders().empty());
}

TEST_CASE("colliders: every option of them is a parameter, and friction can be changed while it slides") {
  Simulation simulation = drape({.threads = 1});
  const ColliderId ball = simulation.find_collider("ball").value();
  set_parameter(simulation, {ball, "radius"}, {0.1, 0, 0});
  CHECK(simulation.options<SphereCollider>(ball)->radius == 0.1);
  set_parameter(simulation, {ball, "center"}, {0, 0, 0.05});
  CHECK(simulation.pose(ball).position == Vec3(0, 0, 0));
  simulation.step();
  CHECK(simulation.pose(ball).position == Vec3(0, 0, 0.05));
  set_parameter(simulation, {ContactOwner{}, "friction"}, {0.7, 0, 0});
  CHECK(simulation.contact().friction == 0.7);
  CHECK_FALSE(refusal([&] { set_parameter(simulation, {ball, "radius"}, {-1, 0, 0}); }).empty());
  CHECK(simulation.options<SphereCollider>(ball)->radius == 0.1);
}

TEST_CASE("colliders: a state of other colliders is refused by name") {
  Simulation simulation = drape({.threads = 1}, 6);
  advance_by(simulation, 30);
  const State state = simulation.state();
  Simulation other = drape({.threads = 1}, 6);
  other.remove(other.find_collider("pole").value());
  CHECK(refusal([&] { other.restore(state); }).find("its colliders are others") != std::string::npos);
  Simulation same = drape({.threads = 1}, 6);
  State broken = state;
  broken.contact.memory = {{.vertex = 99, .collider = 0}};
  CHECK(refusal([&] { same.restore(broken); }).find("a vertex or a collider that there is not") != std::string::npos);
  broken = state;
  broken.contact.stiffening = {1, 2};
  CHECK_FALSE(refusal([&] { same.restore(broken); }).empty());
  broken = state;
  broken.contact.in_factor.assign(36, -1);
  CHECK(refusal([&] { same.restore(broken); }).find("what the factor has of contact") != std::string::npos);
}

}  // namespace test_simulation_colliders
