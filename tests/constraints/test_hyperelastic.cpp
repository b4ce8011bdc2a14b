// Elastic materials against closed forms: energies, a bar that is pulled, small strains, shapes turned inside out.
#include <doctest/doctest.h>

#include "../core/random.h"
#include "../simulation/run.h"
#include "elastic.h"
#include "pliant/collision/colliders/builtin.h"
#include "pliant/constraints/builtin.h"
#include "pliant/forces/builtin.h"
#include "pliant/mesh/lattice.h"
#include "pliant/mesh/shapes.h"
#include "pliant/mesh/topology.h"
#include "pliant/simulation/carried_surface.h"

namespace test_hyperelastic {

using namespace pliant;
using namespace pliant_tests;

namespace {

Mesh block() {
  return bar({.cells = {2, 2, 2}, .size = {1, 1, 1}});
}
Mesh sheet() {
  return grid({.columns = 4, .rows = 4, .size = {1, 1}, .plane = Plane::xy});
}

/// Energy of a mesh of unit size of which every element has this F.
template <class Constraint>
Real energy_of(const Mesh& mesh, const Constraint& options, const Mat3& F) {
  Elastic elastic(mesh, options);
  return elastic.energy(mesh.vertices * F.transpose());
}

Mat3 shear(Real gamma) {
  Mat3 F = Mat3::Identity();
  F(0, 1) = gamma;
  return F;
}

struct Lame {
  Real mu, lambda;
};
Lame lame(Real stiffness, Real nu) {
  return {stiffness / (2 * (1 + nu)), stiffness * nu / ((1 + nu) * (1 - 2 * nu))};
}
Lame lame_of_sheet(Real stiffness, Real nu) {
  return {stiffness / (2 * (1 + nu)), stiffness * nu / (1 - nu * nu)};
}

/// Of small strains ε: the energy μ ‖ε‖² + λ/2 (tr ε)², of a unit of area or volume.
template <class Constraint>
void check_small_strains(const Mesh& mesh, Lame (*moduli)(Real, Real)) {
  constexpr Real small = 1e-6;
  for (const Real nu : {0.0, 0.2, 0.45, 0.49}) {
    CAPTURE(nu);
    const Constraint options{.stiffness = 7e4, .poisson_ratio = nu};
    const auto [mu, lambda] = moduli(7e4, nu);
    const Mat3 stretched = Vec3(1 + small, 1, 1).asDiagonal();
    const Mat3 both = Vec3(1 + small, 1 - 2 * small, 1).asDiagonal();
    const auto energy = [&](const Mat3& F) { return energy_of(mesh, options, F) / (small * small); };
    const Real mu_part = mu, lambda_part = lambda;  // clang 14 captures no structured binding
    CHECK(energy(stretched) == doctest::Approx(mu_part + lambda_part / 2).epsilon(1e-4));
    CHECK(energy(both) == doctest::Approx(5 * mu_part + lambda_part / 2).epsilon(1e-4));
    CHECK(energy(shear(small)) == doctest::Approx(mu_part / 2).epsilon(1e-4));
  }
}

/// Nominal stresses of the law along x and across, of a Young's modulus of 1, stretched by a along x and b across.
std::pair<Real, Real> stresses(NeoHookean, Real nu, Real a, Real b) {
  const auto [mu_at_rest, lambda_at_rest] = lame(1, nu);
  const Real mu = 4 * mu_at_rest / 3, lambda = lambda_at_rest + 5 * mu_at_rest / 6;
  const Real alpha = 1 + 3 * mu / (4 * lambda);
  const Real of_f = mu * (1 - 1 / (a * a + 2 * b * b + 1)), of_j = lambda * (a * b * b - alpha);
  return {of_f * a + of_j * b * b, of_f * b + of_j * a * b};
}
std::pair<Real, Real> stresses(StVenantKirchhoff, Real nu, Real a, Real b) {
  const auto [mu, lambda] = lame(1, nu);
  const Real along = (a * a - 1) / 2, across = (b * b - 1) / 2, trace = along + 2 * across;
  return {a * (2 * mu * along + lambda * trace), b * (2 * mu * across + lambda * trace)};
}

/// The root of a function that rises from a negative to a positive value.
template <class Function>
Real root(Real low, Real high, const Function& function) {
  for (int i = 0; i < 200; ++i) {
    const Real middle = (low + high) / 2;
    (function(middle) < 0 ? low : high) = middle;
  }
  return low;
}

/// Stretches along and across of a bar that nothing holds at its sides, under a nominal stress in Young's moduli.
template <class Law>
std::pair<Real, Real> stretches(Real nu, Real stress) {
  const auto across = [nu](Real a) {
    return root(0.3, 1.5, [nu, a](Real b) { return stresses(Law{}, nu, a, b).second; });
  };
  const Real a = root(1, 10, [&](Real along) { return stresses(Law{}, nu, along, across(along)).first - stress; });
  return {a, across(a)};
}

/// Of the force on a face of a mesh: an equal share of each triangle to its vertices.
std::vector<Real> face_areas(const Mesh& mesh, Real x) {
  std::vector<Real> areas(static_cast<std::size_t>(mesh.vertex_count()), 0);
  for (const Triangle& triangle : boundary_triangles(mesh.tetrahedra)) {
    const auto corner = [&](std::size_t i) { return row(mesh.vertices, triangle[i]); };
    const auto is_on_face = [&](std::size_t i) { return std::abs(corner(i)[0] - x) < 1e-9; };
    if (!is_on_face(0) || !is_on_face(1) || !is_on_face(2)) continue;
    const Real area = (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm() / 2;
    for (const Index vertex : triangle) areas[static_cast<std::size_t>(vertex)] += area / 3;
  }
  return areas;
}

constexpr Real length = 1, width = 0.4;

/// A bar whose ends are pulled apart, at rest.
template <class Constraint>
Simulation pulled(const Constraint& options, Real stress) {
  SolverSettings settings = converged(1e-9 * options.stiffness[0], 100);
  settings.precision = Precision::double_;
  Simulation simulation(settings);
  const Mesh mesh = bar({.cells = {4, 2, 2}, .size = {length, width, width}});
  const BodyId body = simulation.add_body(mesh, Mass::density(1000));
  simulation.add(body, options);
  const std::vector<Real> left = face_areas(mesh, 0), right = face_areas(mesh, length);
  std::vector<Vec3> forces;
  for (std::size_t i = 0; i < left.size(); ++i) {
    forces.emplace_back(stress * options.stiffness[0] * (right[i] - left[i]), 0, 0);
  }
  simulation.add(body, TestForce{.force = forces});
  advance(simulation, 30);
  return simulation;
}

Vec3 extent(const Simulation& simulation) {
  const Positions& x = simulation.state().positions;
  return (x.colwise().maxCoeff() - x.colwise().minCoeff()).transpose();
}

template <class Law>
void check_pulled_bar(Real nu, Real stress) {
  CAPTURE(nu);
  const auto [along, across] = stretches<Law>(nu, stress);
  const Simulation simulation = pulled(ElasticTetrahedra<Law>{.stiffness = 1e5, .poisson_ratio = nu}, stress);
  const Vec3 size = extent(simulation);
  CHECK(size[0] / length == doctest::Approx(along).epsilon(1e-6));
  CHECK(size[1] / width == doctest::Approx(across).epsilon(1e-6));
  CHECK(size[2] / width == doctest::Approx(across).epsilon(1e-6));
}

Real volume(const Mesh& mesh, const Positions& x) {
  Real sum = 0;
  for (const Tetrahedron& t : mesh.tetrahedra) {
    const Vec3 origin = row(x, t[0]);
    const Vec3 a = row(x, t[1]) - origin, b = row(x, t[2]) - origin, c = row(x, t[3]) - origin;
    sum += a.cross(b).dot(c) / 6;
  }
  return sum;
}

/// How far a shape is from one moved rigidly: the largest change of a distance between two vertices.
Real distortion(const Mesh& mesh, const Positions& x) {
  Real worst = 0;
  for (Index i = 0; i < mesh.vertex_count(); ++i) {
    for (Index j = 0; j < i; ++j) {
      const Real at_rest = (row(mesh.vertices, i) - row(mesh.vertices, j)).norm();
      worst = std::max(worst, std::abs((row(x, i) - row(x, j)).norm() - at_rest));
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("small strains cost what they cost in any material of these moduli") {
  check_small_strains<TetrahedronNeoHookean>(block(), lame);
  check_small_strains<TetrahedronStvk>(block(), lame);
  check_small_strains<TriangleNeoHookean>(sheet(), lame_of_sheet);
  check_small_strains<TriangleStvk>(sheet(), lame_of_sheet);
}

TEST_CASE("energies of large strains") {
  const Mat3 F = Vec3(2, 0.5, 3).asDiagonal();
  const auto [mu, lambda] = lame(1, 0.25);  // 0.4, 0.4
  CHECK(energy_of(block(), TetrahedronStvk{.stiffness = 1, .poisson_ratio = 0.25}, F) ==
        doctest::Approx(0.4 * (1.5 * 1.5 + 0.375 * 0.375 + 16) + 0.2 * 5.125 * 5.125).epsilon(1e-12));
  const Real m = 4 * mu / 3, l = lambda + 5 * mu / 6, alpha = 1 + 3 * m / (4 * l), trace = 13.25;
  const auto psi = [&](Real J, Real squares) {
    return m / 2 * (squares - 3) + l / 2 * (J - alpha) * (J - alpha) - m / 2 * std::log(squares + 1);
  };
  const TetrahedronNeoHookean soft{.stiffness = 1, .poisson_ratio = 0.25};
  CHECK(energy_of(block(), soft, F) == doctest::Approx(psi(3, trace) - psi(1, 3)).epsilon(1e-12));
  const Mat3 mirrored = Vec3(2, -0.5, 3).asDiagonal();
  CHECK(energy_of(block(), soft, mirrored) == doctest::Approx(psi(-3, trace) - psi(1, 3)).epsilon(1e-12));
  const Mat3 flat = Vec3(2, 0, 3).asDiagonal();
  CHECK(energy_of(block(), soft, flat) == doctest::Approx(psi(0, 13) - psi(1, 3)).epsilon(1e-12));
  const Real of_sheet = energy_of(sheet(), TriangleNeoHookean{.stiffness = 1, .poisson_ratio = 0}, F);
  CHECK(of_sheet == doctest::Approx(0.25 * (4.25 - 2)).epsilon(1e-12));  // its area stays
  CHECK(energy_of(sheet(), TriangleStvk{.stiffness = 1, .poisson_ratio = 0}, F) ==
        doctest::Approx(0.5 * (1.5 * 1.5 + 0.375 * 0.375)).epsilon(1e-12));
}

TEST_CASE("energies go on where the formula for what is near rest begins") {
  for (const Real nu : {0.0, 0.45}) {
    const auto check = [](const Mesh& mesh, const auto& options) {
      const auto at_size = [&](Real size) {  // ‖G‖² passes 0.01 at a size of 1
        const Mat3 C = Mat3::Identity() + 0.2 * size * Vec3(0.6, 0.8, 0).asDiagonal().toDenseMatrix();
        return energy_of(mesh, options, Mat3(C.diagonal().cwiseSqrt().asDiagonal()));
      };
      CHECK(at_size(1 + 1e-12) == doctest::Approx(at_size(1 - 1e-12)).epsilon(1e-10));
    };
    check(block(), TetrahedronNeoHookean{.poisson_ratio = nu});
    check(sheet(), TriangleNeoHookean{.poisson_ratio = nu});
  }
}

TEST_CASE("a pulled bar has the stretches of its closed form") {
  for (const Real nu : {0.0, 0.3, 0.45, 0.49}) {
    check_pulled_bar<NeoHookean>(nu, 0.4);
    check_pulled_bar<StVenantKirchhoff>(nu, 0.4);
  }
}

TEST_CASE("rubber of Poisson's ratio 0.49 keeps its volume when it is stretched by more than half") {
  const auto [along, across] = stretches<NeoHookean>(0.49, 0.4);
  CHECK(along > 1.5);
  CHECK(along * across * across == doctest::Approx(1).epsilon(0.015));
  const Mesh mesh = bar({.cells = {4, 2, 2}, .size = {length, width, width}});
  const Simulation simulation = pulled(TetrahedronNeoHookean{.poisson_ratio = 0.49}, 0.4);
  CHECK(volume(mesh, simulation.state().positions) / volume(mesh, mesh.vertices) ==
        doctest::Approx(along * across * across).epsilon(1e-6));
}

TEST_CASE("what is turned inside out, flattened or shuffled comes back to rest") {
  const Mesh mesh = bar({.cells = {3, 2, 2}, .size = {0.6, 0.4, 0.4}});
  Random random;
  Positions mirrored = mesh.vertices, flat = mesh.vertices;
  mirrored.col(2) *= -1;
  flat.col(2) *= 0;
  const std::vector<Positions> starts = {mirrored, flat, mesh.vertices + random.positions(mesh.vertex_count(), 0.2)};
  for (const Real nu : {0.3, 0.45}) {
    for (std::size_t i = 0; i < starts.size(); ++i) {
      CAPTURE(nu);
      CAPTURE(i);
      Simulation simulation({.time_step = 0.02, .iterations = 30, .threads = 1});
      const BodyId body = simulation.add_body(mesh, Mass::density(1000), {.start = starts[i]});
      simulation.add(body, TetrahedronNeoHookean{.stiffness = 1e5, .poisson_ratio = nu});
      advance(simulation, 400);
      CHECK(distortion(mesh, simulation.state().positions) < 1e-3);
      CHECK(volume(mesh, simulation.state().positions) > 0);
    }
  }
}

TEST_CASE("a load that the prediction follows for a thousand kilometers is brought to its end") {
  const Simulation simulation = pulled(TetrahedronNeoHookean{.poisson_ratio = 0.3}, 2);  // steps of 100 s
  CHECK(extent(simulation)[0] / length == doctest::Approx(stretches<NeoHookean>(0.3, 2).first).epsilon(1e-6));
}

TEST_CASE("no iteration raises the objective, with acceleration or without") {
  const Mesh mesh = bar({.cells = {4, 2, 2}, .size = {0.8, 0.4, 0.4}});
  for (const Acceleration acceleration : {Acceleration::none, Acceleration::lbfgs, Acceleration::automatic,
                                          Acceleration::anderson, Acceleration::chebyshev}) {
    for (const Real time_step : {1.0 / 60, 1.0}) {
      Random random;
      Simulation simulation({.time_step = time_step, .iterations = 40, .acceleration = acceleration, .threads = 1});
      const BodyId body =
          simulation.add_body(mesh, Mass::density(1000), {.start = random.positions(mesh.vertex_count(), 0.4)});
      simulation.add(body, TetrahedronNeoHookean{.stiffness = 1e5, .poisson_ratio = 0.49});
      add_gravity(simulation);
      for (int step = 0; step < 5; ++step) {
        simulation.step();
        const auto history = simulation.objective_history();
        REQUIRE(history.size() > 1);
        for (std::size_t i = 1; i < history.size(); ++i) CHECK(history[i] <= history[i - 1] * (1 + 1e-11));
      }
    }
  }
}

TEST_CASE("a body at rest stays at rest, wherever it is and however it is turned") {
  Random random;
  const auto check = [&](const Mesh& mesh, const auto& options) {
    Simulation simulation({.threads = 1});
    const Positions start = moved(mesh.vertices, random.rotation(), random.vector(3));
    const BodyId body = simulation.add_body(mesh, Mass::total(1), {.start = start});
    simulation.add(body, options);
    advance(simulation, 200);
    CHECK(largest_difference(simulation.state().positions, start) < 1e-12);
  };
  check(block(), TetrahedronNeoHookean{.poisson_ratio = 0.49});
  check(block(), TetrahedronStvk{});
  check(sheet(), TriangleNeoHookean{});
  check(sheet(), TriangleStvk{.poisson_ratio = 0.49});
}

TEST_CASE("a lattice of Neo-Hookean tetrahedra carries its surface by stiff ties") {
  Simulation simulation({.substeps = 4, .threads = 1});
  const BodyId body =
      simulation.add_body(lattice_solid(sphere({.subdivisions = 2}), {.spacing = 0.5}, "ball"), Mass::density(5));
  simulation.add(body, TetrahedronNeoHookean{.stiffness = 3e4});
  CHECK(tetrahedron_stiffness(simulation, body) == 3e4);
  const GroupId ties = carry_surface(simulation, body);
  CHECK(simulation.stiffness(ties) == tie_ratio * 3e4);
  simulation.add(body, Position{.on = {0}});
  add_gravity(simulation);
  advance(simulation, 60);
  CHECK(simulation.state().positions.allFinite());
  const Real worst = largest_departure(simulation, body);
  CHECK(worst < 0.02);
}

TEST_CASE("in contact moves of elastic materials are made shorter, not thrown away") {
  Simulation simulation({.iterations = 10, .threads = 1});
  const Mesh mesh = bar({.cells = {3, 3, 3}, .size = {0.3, 0.3, 0.3}});
  Positions velocities = Positions::Zero(mesh.vertex_count(), 3);
  velocities.col(2).setConstant(-5);
  const BodyId body = simulation.add_body(mesh, Mass::density(1000), {.velocities = velocities});
  simulation.add(body, TetrahedronNeoHookean{.stiffness = 3000, .poisson_ratio = 0.49});
  simulation.add(PlaneCollider{.position = {0, 0, -0.3}}, "floor");
  add_gravity(simulation);
  std::size_t moves = 0, unchanged = 0;
  for (int step = 0; step < 60; ++step) {
    simulation.step();
    const auto history = simulation.objective_history();
    for (std::size_t i = 1; i < history.size(); ++i, ++moves) unchanged += history[i] == history[i - 1] ? 1 : 0;
  }
  CHECK(simulation.state().positions.allFinite());
  CHECK(moves > 400);
  CHECK(unchanged < moves / 20);
}

TEST_CASE(
    "elastic materials have the same bits with any number of threads, integrator and substeps, and after a copy") {
  const auto make = [](Index threads, Integrator integrator, Index substeps) {
    Simulation simulation({.integrator = integrator, .substeps = substeps, .iterations = 6, .threads = threads});
    const Mesh mesh = bar({.cells = {30, 6, 6}, .size = {1, 0.2, 0.2}});
    const BodyId body = simulation.add_body(mesh, Mass::density(1000));
    simulation.add(body, TetrahedronNeoHookean{.stiffness = 1e5, .poisson_ratio = 0.48});
    simulation.add(body, TetrahedronStvk{.stiffness = 1e4, .poisson_ratio = 0.3});
    simulation.add(body, Position{.on = {0, 1, 2}});
    add_gravity(simulation);
    return simulation;
  };
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    for (const Index substeps : {1, 3}) {
      Simulation one = make(1, integrator, substeps), many = make(3, integrator, substeps);
      advance(one, 4);
      advance(many, 4);
      CHECK(one.state().positions == many.state().positions);
      Simulation copy = one.copy();
      advance(one, 4);
      advance(copy, 4);
      CHECK(one.state().positions == copy.state().positions);
    }
  }
}

}  // namespace test_hyperelastic
