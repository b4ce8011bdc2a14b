// What holds for every constraint type on every kind of mesh, written once over the list of types.
#include <doctest/doctest.h>

#include "../constraints/elastic.h"
#include "../core/random.h"
#include "../mesh/meshes.h"
#include "pliant/constraints/builtin.h"
#include "pliant/mesh/shapes.h"
#include "pliant/mesh/topology.h"

namespace test_constraint_types {

using namespace pliant;
using namespace pliant_tests;

namespace {

struct NamedMesh {
  std::string name;
  Mesh mesh;
};

std::vector<NamedMesh> meshes() {
  Mesh block = bar({.cells = {3, 2, 1}, .size = {1, 0.6, 0.3}});
  block.triangles = boundary_triangles(block.tetrahedra);
  return {{"grid", grid({.columns = 5, .rows = 4})},
          {"torus", torus({.major_segments = 8, .minor_segments = 6})},
          {"sphere", sphere({.subdivisions = 1})},
          {"bar", std::move(block)},
          {"moebius", moebius_strip(12)}};
}

/// Options that make sense on each of those meshes, `signed` last where there is a choice.
template <class Constraint>
std::vector<Constraint> variants(const Mesh&) {
  return {Constraint{}};
}
template <>
std::vector<Position> variants(const Mesh&) {
  return {{.hold = Hold::soft}, {.on = {0, 3, 5}, .hold = Hold::soft, .stiffness = Values({1, 20, 3})}};
}
template <>
std::vector<Line> variants(const Mesh&) {
  return {{.direction = Vec3(1, 2, -3)}};
}
template <>
std::vector<OnPlane> variants(const Mesh&) {
  return {{.normal = Vec3(1, 2, -3)}};
}
template <>
std::vector<InHalfSpace> variants(const Mesh&) {
  return {{.normal = Vec3(1, 2, -3)}, {.on = {0, 3}, .normal = Vec3(0, 0, 2)}};
}
template <>
std::vector<EdgeSpring> variants(const Mesh& mesh) {
  std::vector<Real> each(unique_edges(mesh).size(), 2);
  each[0] = 1e3;
  return {{}, {.stiffness = each}, {.reduction = EdgeReduction::identity}};
}
template <>
std::vector<EdgeStrain> variants(const Mesh&) {
  return {{}, {.min_stretch = 0, .max_stretch = 1.1}};
}
template <>
std::vector<TriangleStrain> variants(const Mesh&) {
  return {{}, {.min_stretch = 0.9, .max_stretch = 1.1}};
}
template <>
std::vector<FibreStrain> variants(const Mesh&) {
  return {{.grain = Grain::edge},
          {.direction = Vec3(1, 2, -3), .angle = 30},
          {.angle = 90, .min_stretch = 0, .max_stretch = 1.1},
          {.taut_factor = 7, .taut_stretch = 1.05},
          {.taut_factor = 7, .taut_stretch = 1.05, .taut_onset = 1.0}};
}
template <>
std::vector<TriangleArea> variants(const Mesh&) {
  return {{}, {.min_area = 0.9, .max_area = 1.1}, {.min_area = 0}};
}
template <>
std::vector<TetrahedronVolume> variants(const Mesh&) {
  return {{}, {.min_volume = 0.9, .max_volume = 1.1}};
}
template <>
std::vector<TetrahedronStrain> variants(const Mesh&) {
  return {{}, {.min_stretch = 0.9, .max_stretch = 1.1}};
}
template <class Law>
std::vector<ElasticTriangles<Law>> elastic_triangles() {
  return {{}, {.poisson_ratio = 0}, {.stiffness = 7, .poisson_ratio = 0.49}};
}
template <>
std::vector<TriangleNeoHookean> variants(const Mesh&) {
  return elastic_triangles<NeoHookean>();
}
template <>
std::vector<TriangleStvk> variants(const Mesh&) {
  return elastic_triangles<StVenantKirchhoff>();
}
template <class Law>
std::vector<ElasticTetrahedra<Law>> elastic_tetrahedra() {
  return {{}, {.poisson_ratio = 0}, {.stiffness = 7, .poisson_ratio = 0.49}};
}
template <>
std::vector<TetrahedronNeoHookean> variants(const Mesh&) {
  return elastic_tetrahedra<NeoHookean>();
}
template <>
std::vector<TetrahedronStvk> variants(const Mesh&) {
  return elastic_tetrahedra<StVenantKirchhoff>();
}
template <>
std::vector<Bending> variants(const Mesh&) {
  return {{}, {.orientation = Orientation::signed_}};
}
template <>
std::vector<HingeBending> variants(const Mesh&) {
  return {{}, {.orientation = Orientation::signed_}};
}
template <>
std::vector<TriangleBending> variants(const Mesh&) {
  return {{}, {.orientation = Orientation::signed_}};
}
template <>
std::vector<Drag> variants(const Mesh& mesh) {
  Drag drag{.stencils = {{4}, {1, 0}}, .weights = {{1}, {0.25, 0.75}}};
  const Triangle& triangle = mesh.triangles[0];
  drag.stencils.add(triangle);
  drag.weights.add({0.5, 0.3, 0.2});
  return {drag};
}

template <class Constraint>
constexpr bool is_anchored =
    std::is_same_v<Constraint, Position> || std::is_same_v<Constraint, Line> || std::is_same_v<Constraint, OnPlane> ||
    std::is_same_v<Constraint, InHalfSpace> || std::is_same_v<Constraint, Drag>;

/// True when the frozen normals of `signed` stand in space, so that torque is not balanced within a step.
template <class Constraint>
bool has_frozen_normals(const Constraint& options) {
  if constexpr (requires { options.orientation; }) return options.orientation == Orientation::signed_;
  return false;
}

Positions deformed(const Mesh& mesh, Random& random) {
  return mesh.vertices + random.positions(mesh.vertex_count(), 0.05);
}

template <class Constraint, class Check>
void for_all(Check&& check) {
  int constraints = 0;
  for (const auto& [name, mesh] : meshes()) {
    for (const Constraint& options : variants<Constraint>(mesh)) {
      const std::string mesh_name = name;  // clang 14 captures no structured binding
      CAPTURE(mesh_name);
      Elastic elastic(mesh, options);
      constraints += elastic.set().count;
      check(mesh, options, elastic);
    }
  }
  CHECK(constraints > 0);
}

}  // namespace

TEST_CASE_TEMPLATE_DEFINE("a body at rest has neither force nor energy", Type, at_rest) {
  for_all<Type>([](const Mesh& mesh, const Type&, Elastic& elastic) {
    Random random;
    const Positions q = deformed(mesh, random);
    const Real force = elastic.forces(q).cwiseAbs().maxCoeff();
    const Real energy = elastic.energy(q);
    elastic.begin_step(mesh.vertices);
    CHECK(elastic.forces(mesh.vertices).cwiseAbs().maxCoeff() <= 1e-12 * force);
    CHECK(std::abs(elastic.energy(mesh.vertices)) <= 1e-24 * energy);
  });
}
TEST_CASE_TEMPLATE_APPLY(at_rest, BuiltinConstraints);

TEST_CASE_TEMPLATE_DEFINE("inner forces sum to zero, and so do their torques", Type, balanced) {
  for_all<Type>([](const Mesh& mesh, const Type& options, Elastic& elastic) {
    if (is_anchored<Type>) return;
    Random random;
    const Positions q = deformed(mesh, random);
    elastic.begin_step(mesh.vertices);
    const Positions f = elastic.forces(q);
    Vec3 torque = Vec3::Zero();
    for (Index i = 0; i < q.rows(); ++i) torque += row(q, i).cross(row(f, i));
    const Real scale = f.cwiseAbs().sum();
    CHECK(f.colwise().sum().norm() <= 1e-13 * scale);
    if (!has_frozen_normals(options)) CHECK(torque.norm() <= 1e-13 * scale);
  });
}
TEST_CASE_TEMPLATE_APPLY(balanced, BuiltinConstraints);

TEST_CASE_TEMPLATE_DEFINE("the force is minus the gradient of the energy", Type, force_is_gradient) {
  for_all<Type>([](const Mesh& mesh, const Type&, Elastic& elastic) {
    Random random;
    constexpr Real h = 1e-6;
    Positions q = deformed(mesh, random);
    elastic.begin_step(mesh.vertices);
    const Positions f = elastic.forces(q);
    const Real scale = f.cwiseAbs().maxCoeff() + elastic.energy(q);
    for (int sample = 0; sample < 30; ++sample) {
      Real& x = q.data()[random.index(static_cast<Index>(q.size()))];
      const Real before = x;
      x = before + h;
      const Real ahead = elastic.energy(q);
      x = before - h;
      const Real behind = elastic.energy(q);
      x = before;
      CHECK(std::abs((ahead - behind) / (2 * h) + f.data()[&x - q.data()]) <= 1e-6 * scale);
    }
  });
}
TEST_CASE_TEMPLATE_APPLY(force_is_gradient, BuiltinConstraints);

TEST_CASE_TEMPLATE_DEFINE("the energy does not change when the body is turned and moved", Type, rigid) {
  for_all<Type>([](const Mesh& mesh, const Type&, Elastic& elastic) {
    if (is_anchored<Type>) return;
    Random random;
    for (int i = 0; i < 5; ++i) {
      const Positions q = deformed(mesh, random);
      elastic.begin_step(q);
      const Real energy = elastic.energy(q);
      const Positions elsewhere = moved(q, random.rotation(), random.vector(10));
      elastic.begin_step(elsewhere);
      CHECK(elastic.energy(elsewhere) == doctest::Approx(energy).epsilon(1e-11));
    }
  });
}
TEST_CASE_TEMPLATE_APPLY(rigid, BuiltinConstraints);

TEST_CASE_TEMPLATE_DEFINE("what says that it turns with the body does so in the middle of a step", Type, turning) {
  for_all<Type>([](const Mesh& mesh, const Type& options, Elastic& elastic) {
    bool turns = true;
    for (const auto& batch : elastic.set().batches) turns &= batch->is_rotation_invariant();
    if (!has_frozen_normals(options)) CHECK(turns == !is_anchored<Type>);
    if (!turns) return;
    Random random;
    for (int i = 0; i < 5; ++i) {
      const Positions q = deformed(mesh, random);
      elastic.begin_step(q);
      const Real energy = elastic.energy(q);
      const Positions forces = elastic.forces(q);
      const Mat3 rotation = random.rotation();
      const Positions elsewhere = moved(q, rotation, random.vector(10));
      CHECK(elastic.energy(elsewhere) == doctest::Approx(energy).epsilon(1e-11));
      const Real error = (elastic.forces(elsewhere) - forces * rotation.transpose()).cwiseAbs().maxCoeff();
      CHECK(error <= 1e-10 * forces.cwiseAbs().maxCoeff());
    }
  });
}
TEST_CASE_TEMPLATE_APPLY(turning, BuiltinConstraints);

TEST_CASE_TEMPLATE_DEFINE("the energy grows in proportion to the stiffness", Type, linear_in_stiffness) {
  for_all<Type>([](const Mesh& mesh, const Type& options, Elastic& elastic) {
    if (options.stiffness.each()) return;
    Random random;
    const Positions q = deformed(mesh, random);
    Type stiffer = options;
    stiffer.stiffness = 7 * options.stiffness[0];
    elastic.begin_step(q);
    const Real energy = elastic.energy(q);
    const Positions f = elastic.forces(q);
    Elastic other(mesh, stiffer);
    other.begin_step(q);
    CHECK(other.energy(q) == doctest::Approx(7 * energy).epsilon(1e-13));
    for (const auto& batch : elastic.set().batches) batch->set_stiffness(stiffer.stiffness[0]);
    CHECK(elastic.energy(q) == doctest::Approx(7 * energy).epsilon(1e-13));
    CHECK((elastic.forces(q) - 7 * f).norm() <= 1e-13 * f.norm() * 7);
  });
}
TEST_CASE_TEMPLATE_APPLY(linear_in_stiffness, BuiltinConstraints);

}  // namespace test_constraint_types
