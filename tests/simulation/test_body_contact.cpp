// How a single body touches: its distance, its friction, whether it meets itself, whom it ignores.
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "../mesh/meshes.h"
#include "pliant/collision/colliders/builtin.h"
#include "pliant/pliant.h"
#include "pliant/simulation/transaction.h"

namespace test_body_contact {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// A square of n × n vertices, `width` [m] wide, level at `height` [m].
Mesh level_sheet(Index n, Real width, Real height) {
  Mesh mesh = grid({.columns = n, .rows = n, .size = {width, width}, .plane = Plane::xy});
  mesh.vertices.rowwise() += Eigen::RowVector3d(-width / 2, -width / 2, height);
  return mesh;
}

Mesh joined(const Mesh& a, const Mesh& b) {
  Mesh mesh = a;
  mesh.vertices.conservativeResize(a.vertex_count() + b.vertex_count(), 3);
  mesh.vertices.bottomRows(b.vertex_count()) = b.vertices;
  for (const auto& [i, j, k] : b.triangles) {
    mesh.triangles.push_back({i + a.vertex_count(), j + a.vertex_count(), k + a.vertex_count()});
  }
  return mesh;
}

BodyId add_sheet(Simulation& simulation, const Mesh& mesh) {
  const BodyId body = simulation.add_body(mesh, Mass::area_density(0.3));
  simulation.add(body, TriangleStrain{.stiffness = 500});
  simulation.add(body, Bending{.stiffness = 1e-3});
  return body;
}

SolverSettings settings_of_test() {
  return {.iterations = 20, .threads = 1};
}

/// A small sheet that falls onto one that is held, 4 cm below it; both are on their own.
struct TwoSheets {
  Simulation simulation{settings_of_test()};
  BodyId held = add_sheet(simulation, level_sheet(8, 0.5, 0));
  BodyId falling = add_sheet(simulation, level_sheet(5, 0.2, 0.04));

  TwoSheets() {
    simulation.add(held, Position{});
    simulation.add(Gravity{});
    simulation.set_contact({.distance = 0.01, .surfaces = true});
  }
  Real height() const {
    const Body& body = simulation.body(falling);
    return simulation.state().positions.middleRows(body.first_vertex, body.mesh.vertex_count()).col(2).mean();
  }
  Real height_after(int steps) {
    for (int i = 0; i < steps; ++i) simulation.step();
    return height();
  }
};

/// How far a sheet that lies on the floor, or on a held sheet, and is pushed off at 1 m/s slides in 0.2 s.
Real slid(const Real friction_of_settings, std::optional<Real> of_sheet, std::optional<Real> of_ground, bool is_plane) {
  Simulation simulation({.iterations = 40, .threads = 1});
  const Real r = 0.005;
  const BodyId sheet = add_sheet(simulation, level_sheet(4, 0.15, r));
  if (is_plane) {
    PlaneCollider plane;
    if (of_ground) plane.friction = *of_ground;
    simulation.add(plane);
  } else {
    const BodyId ground = add_sheet(simulation, level_sheet(12, 0.9, 0));
    simulation.add(ground, Position{});
    simulation.set_contact(ground, {.friction = of_ground});
  }
  simulation.add(Gravity{});
  simulation.set_contact({.distance = r, .friction = friction_of_settings, .surfaces = !is_plane});
  simulation.set_contact(sheet, {.friction = of_sheet});
  const Body& body = simulation.body(sheet);
  const auto place = [&] { return simulation.state().positions.middleRows(body.first_vertex, 16).col(0).mean(); };
  for (int i = 0; i < 20; ++i) simulation.step();
  Positions velocities = Positions::Zero(simulation.state().vertex_count(), 3);
  velocities.middleRows(body.first_vertex, 16).col(0).setOnes();
  simulation.set_state(simulation.state().positions, velocities);
  const Real begin = place();
  for (int i = 0; i < 12; ++i) simulation.step();
  return place() - begin;
}

/// The same by implicit Euler, with this friction: v falls by μ g h a step.
Real slid_exactly(Real friction) {
  Real speed = 1, way = 0;
  for (int i = 0; i < 12; ++i) {
    speed = std::max<Real>(0, speed - friction * 9.81 / 60);
    way += speed / 60;
  }
  return way;
}

}  // namespace

TEST_CASE("body contact: friction of a pair is that of the side that has its own, or the mean of both") {
  CHECK(friction_between(std::nullopt, std::nullopt, 0.3) == 0.3);
  CHECK(friction_between(0.0, std::nullopt, 0.3) == 0);
  CHECK(friction_between(std::nullopt, 0.7, 0.3) == 0.7);
  CHECK(friction_between(0.1, 0.4, 0.3) == doctest::Approx(0.2).epsilon(1e-14));
  CHECK(friction_between(0.3, 0.3, 1) == 0.3);
  CHECK(friction_between(0.0, 5.0, 1) == 0);
  for (const bool is_plane : {true, false}) {
    CAPTURE(is_plane);
    CHECK(slid(0.15, {}, {}, is_plane) == doctest::Approx(slid_exactly(0.15)).epsilon(0.01));
    CHECK(slid(0.15, 0.2, {}, is_plane) == doctest::Approx(slid_exactly(0.2)).epsilon(0.01));
    CHECK(slid(0.15, {}, 0.05, is_plane) == doctest::Approx(slid_exactly(0.05)).epsilon(0.01));
    CHECK(slid(0.15, 0.2, 0.05, is_plane) == doctest::Approx(slid_exactly(0.1)).epsilon(0.01));
    CHECK(slid(0.15, 0.2, 0.2, is_plane) == doctest::Approx(slid_exactly(0.2)).epsilon(0.01));
    CHECK(slid(0.15, 0.0, 0.2, is_plane) == doctest::Approx(slid_exactly(0)).epsilon(0.01));
  }
}

TEST_CASE("body contact: two bodies rest apart by the mean of their distances, a body over a plane by its own") {
  TwoSheets sheets;
  sheets.simulation.set_contact(sheets.held, {.distance = 0.004});
  sheets.simulation.set_contact(sheets.falling, {.distance = 0.016});
  CHECK(sheets.simulation.contact_distance(sheets.falling) == 0.016);
  CHECK(sheets.height_after(120) == doctest::Approx(0.01).epsilon(0.02));
  sheets.simulation.set_contact(sheets.falling, {});
  CHECK(sheets.simulation.contact_distance(sheets.falling) == 0.01);
  CHECK(sheets.height_after(120) == doctest::Approx(0.007).epsilon(0.02));

  Simulation on_plane(settings_of_test());
  const BodyId sheet = add_sheet(on_plane, level_sheet(5, 0.2, 0.03));
  on_plane.add(PlaneCollider{});
  on_plane.add(Gravity{});
  on_plane.set_contact(sheet, {.distance = 0.02});
  for (int i = 0; i < 60; ++i) on_plane.step();
  CHECK(on_plane.state().positions.col(2).mean() == doctest::Approx(0.02).epsilon(0.02));
}

TEST_CASE("body contact: bodies that ignore each other pass through, whichever of them says so") {
  CHECK(TwoSheets().height_after(30) > 0.009);
  for (const bool falling_says : {true, false}) {
    TwoSheets sheets;
    const BodyId other = falling_says ? sheets.held : sheets.falling;
    sheets.simulation.set_contact(falling_says ? sheets.falling : sheets.held, {.ignores = {other}});
    CHECK(sheets.height_after(30) < -0.5);
  }
  // A third one is met all the same.
  TwoSheets sheets;
  const BodyId third = add_sheet(sheets.simulation, level_sheet(8, 0.5, -0.1));
  sheets.simulation.add(third, Position{});
  sheets.simulation.set_contact(sheets.falling, {.ignores = {sheets.held}});
  CHECK(sheets.height_after(60) == doctest::Approx(-0.09).epsilon(0.05));
}

TEST_CASE("body contact: who ignores nothing that is near has the bits that it has without") {
  TwoSheets plain, other;
  for (TwoSheets* each : {&plain, &other}) {
    const BodyId far = add_sheet(each->simulation, level_sheet(4, 0.2, 3));
    each->simulation.add(far, Position{});
    const BodyId farther = add_sheet(each->simulation, level_sheet(4, 0.2, 5));
    each->simulation.add(farther, Position{});
    if (each == &other) each->simulation.set_contact(far, {.ignores = {farther}});
  }
  Index pairs = 0;
  for (int i = 0; i < 30; ++i) {
    pairs += plain.simulation.step().contact.pairs;
    other.simulation.step();
  }
  CHECK(pairs > 0);
  CHECK(plain.simulation.state().positions == other.simulation.state().positions);
}

TEST_CASE("body contact: a body that does not touch itself meets others") {
  const Mesh both = joined(level_sheet(8, 0.5, 0), level_sheet(5, 0.2, 0.04));
  for (const bool self : {true, false}) {
    CAPTURE(self);
    Simulation simulation(settings_of_test());
    const BodyId body = add_sheet(simulation, both);
    std::vector<Index> held(64);
    for (Index i = 0; i < 64; ++i) held[at(i)] = i;
    simulation.add(body, Position{.on = held});
    simulation.add(add_sheet(simulation, level_sheet(8, 0.5, -0.1)), Position{});
    simulation.add(Gravity{});
    simulation.set_contact({.distance = 0.01, .surfaces = true});
    simulation.set_contact(body, {.self = self});
    for (int i = 0; i < 60; ++i) simulation.step();
    const Real height = simulation.state().positions.middleRows(64, 25).col(2).mean();
    CHECK(height == doctest::Approx(self ? 0.01 : -0.09).epsilon(0.05));
  }
}

TEST_CASE("body contact: a transaction takes it back, also what a step of it has led to") {
  TwoSheets untouched, sheets;
  sheets.simulation.set_contact(sheets.held, {.friction = 0.5});
  untouched.simulation.set_contact(untouched.held, {.friction = 0.5});
  untouched.height_after(10), sheets.height_after(10);
  const State before = sheets.simulation.state();
  {
    Transaction transaction(sheets.simulation);
    {
      Transaction inner(sheets.simulation);
      sheets.simulation.set_contact(sheets.falling, {.distance = 0.02, .ignores = {BodyId{0}}});
      inner.commit();
    }
    const BodyId added = add_sheet(sheets.simulation, level_sheet(3, 0.1, 1));
    sheets.simulation.set_contact(sheets.held, {.ignores = {added}});
    sheets.simulation.step();
  }
  sheets.simulation.restore(before);
  CHECK(sheets.simulation.contact(sheets.falling) == BodyContact{});
  CHECK(sheets.simulation.contact(sheets.held) == BodyContact{.friction = 0.5});
  untouched.height_after(10), sheets.height_after(10);
  CHECK(untouched.simulation.state().positions == sheets.simulation.state().positions);
}

TEST_CASE("body contact: what makes no sense is refused, and nothing has changed") {
  TwoSheets sheets;
  Simulation& simulation = sheets.simulation;
  const auto refusal = [&](const BodyContact& contact) {
    return error_of([&] { simulation.set_contact(sheets.falling, contact); });
  };
  constexpr Real inf = std::numeric_limits<Real>::infinity();
  for (const Real wrong : {-1.0, std::nan(""), inf, -inf}) {
    CAPTURE(wrong);
    CHECK(refusal({.distance = wrong}).starts_with("contact of body 'body 1': distance: "));
    CHECK(refusal({.friction = wrong}).starts_with("contact of body 'body 1': friction: "));
  }
  CHECK(refusal({.ignores = {BodyId{2}}}) == "contact of body 'body 1': ignores: body 2 does not exist; there are 2");
  CHECK(refusal({.ignores = {BodyId{-1}}}).find("body -1 does not exist") != std::string::npos);
  CHECK(refusal({.ignores = {BodyId{1}}}).find("set `self` to false") != std::string::npos);
  CHECK_FALSE(error_of([&] { simulation.set_contact(BodyId{7}, {}); }).empty());
  CHECK(simulation.contact(sheets.falling) == BodyContact{});
}

}  // namespace test_body_contact
