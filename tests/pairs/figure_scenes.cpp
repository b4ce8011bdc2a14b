#include "tests/pairs/figure_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

#include "pliant/mesh/join.h"
#include "pliant/mesh/shapes/surfaces.h"
#include "pliant_io/mesh/mesh_file.h"
#include "tests/pairs/parts.h"

namespace pliant_tests {

using namespace pliant;

namespace {

constexpr Real pi = std::numbers::pi;
constexpr Real unit_of_file = 0.06;  // meters of a unit of tshirt.obj

// ---- what moves

/// A rigid motion: x goes to place + rotation (x − center).
struct Motion {
  Mat3 rotation = Mat3::Identity();
  Vec3 center = Vec3::Zero();
  Vec3 place = Vec3::Zero();

  Vec3 operator()(const Vec3& x) const { return place + rotation * (x - center); }
};

Mat3 turned(const Vec3& axis, Real angle) {
  return Eigen::AngleAxis<Real>(angle, axis).toRotationMatrix();
}

/// 0 before the time `begin`, 1 after `end`; from rest to rest.
Real risen(Real time, Real begin, Real end) {
  const Real t = std::clamp<Real>((time - begin) / (end - begin), 0, 1);
  return t * t * (3 - 2 * t);
}

/// The way of something that goes at a speed of 1 from `begin` on, `length` in all, and needs a quarter of a second to
/// get there and to stop.
Real gone(Real time, Real begin, Real length) {
  constexpr Real ramp = 0.25;
  const auto sum = [](Real t) { return t <= 0 ? 0 : t < ramp ? t * t / (2 * ramp) : t - ramp / 2; };
  return sum(time - begin) - sum(time - begin - length);
}

/// Moves all vertices of a body that is held: vertex i as motion part[i] of the motions at a time.
template <class Motions>
std::function<void(Simulation&)> moved(GroupId pins, Positions begin, std::vector<std::size_t> part, Motions motions) {
  return [pins, begin = std::move(begin), part = std::move(part), motions](Simulation& simulation) {
    const auto at_time = motions(simulation.state().time + simulation.settings().time_step);
    for (Index i = 0; i < static_cast<Index>(begin.rows()); ++i) {
      simulation.set_target(pins, i, at_time[part[at(i)]](row(begin, i)));
    }
  };
}

// ---- the figure

enum Part : std::size_t { trunk, left_arm, right_arm, left_leg, right_leg, part_count };

struct Limb {
  Part part;
  Vec3 from, to;
  Real radius, end_radius;
  Real depth = 1;  // of its width
};

constexpr Real hip = 0.84;  // height [m]
const Vec3 left_shoulder(-0.13, -0.024, 1.45);
const Vec3 right_shoulder(0.13, -0.024, 1.45);

std::vector<Limb> limbs() {
  return {{trunk, {0, 0.01, 0.89}, {0, 0, 1.34}, 0.13, 0.125, 0.72},
          {trunk, {-0.115, -0.024, 1.445}, {0.115, -0.024, 1.445}, 0.055, 0.055},
          {trunk, {0, -0.015, 1.45}, {0, -0.015, 1.6}, 0.045, 0.045},
          {trunk, {0, -0.015, 1.68}, {0, -0.015, 1.74}, 0.07, 0.085},
          {left_arm, left_shoulder, {-0.58, -0.02, 1.33}, 0.05, 0.035},
          {right_arm, right_shoulder, {0.58, -0.02, 1.33}, 0.05, 0.035},
          {left_leg, {-0.075, 0.01, 0.08}, {-0.075, 0.01, hip}, 0.045, 0.08},
          {right_leg, {0.075, 0.01, 0.08}, {0.075, 0.01, hip}, 0.045, 0.08}};
}

struct Figure {
  Mesh mesh;
  std::vector<std::size_t> part;  // of each vertex
};

Figure figure_mesh(Real edge) {
  std::vector<MeshPart> parts;
  Figure figure;
  for (const Limb& limb : limbs()) {
    const Real wide = std::max(limb.radius, limb.end_radius);
    const auto segments = std::max<Index>(8, static_cast<Index>(std::lround(2 * pi * wide / edge)));
    const Vec3 way = limb.to - limb.from;
    Mesh mesh =
        capsule({.segments = segments, .radius = limb.radius, .height = way.norm(), .top_radius = limb.end_radius});
    const Mat3 rotation = Quaternion::FromTwoVectors(Vec3::UnitZ(), way).toRotationMatrix();
    for (Index i = 0; i < mesh.vertex_count(); ++i) {
      Vec3 x = rotation * row(mesh.vertices, i);
      x.y() *= limb.depth;
      mesh.vertices.row(i) = (limb.from + x).transpose();
      figure.part.push_back(limb.part);
    }
    parts.push_back({"", std::move(mesh)});
  }
  figure.mesh = join(parts);
  return figure;
}

/// Where the parts of the figure are at a time, if it turns once in `turn`.
std::array<Motion, part_count> figure_motions(Real time, Real turn) {
  const Real first = 3.2;  // when it begins to whirl
  const Real whirl = 2 * turn;
  const Real second = first + whirl + 0.25 + 1.6;
  const Real walks = risen(time, 0.5, 1) - risen(time, 2.6, 3.1) +
                     risen(time, first + whirl + 0.3, first + whirl + 0.6) - risen(time, second - 0.4, second - 0.1);
  const Real way = 0.8 * (gone(time, 0.5, 2.3) - gone(time, second - 1.5, 1.2));
  const Real pace = 2 * pi * (time - 0.5);  // a double step a second
  const Real angle =
      2 * pi / turn * (gone(time, first, whirl) - gone(time, second, whirl)) + 0.08 * walks * std::sin(pace);
  std::array<Motion, part_count> motions;
  const Mat3 yaw = turned(Vec3::UnitZ(), angle);
  const Vec3 place(0, -way, 0.012 * walks * (1 - std::cos(2 * pace)));
  const auto limb = [&](Part part, const Mat3& own, const Vec3& joint) {
    motions[part] = {yaw * own, joint, place + yaw * joint};
  };
  limb(trunk, Mat3::Identity(), Vec3::Zero());
  const Real swing = 0.35 * walks * std::sin(pace);
  limb(left_leg, turned(Vec3::UnitX(), swing), {-0.075, 0.01, hip});
  limb(right_leg, turned(Vec3::UnitX(), -swing), {0.075, 0.01, hip});
  const Real lift = 0.2 * walks * std::sin(pace + 1);
  limb(left_arm, turned(Vec3::UnitZ(), 0.5 * swing) * turned(Vec3::UnitY(), lift), left_shoulder);
  limb(right_arm, turned(Vec3::UnitZ(), 0.5 * swing) * turned(Vec3::UnitY(), lift), right_shoulder);
  return motions;
}

// ---- the shirt

/// Half of its outline, in its plane [m].
struct Outline {
  static constexpr Real neck = 0.075, side = 0.175, cuff = 0.3;
  static constexpr Real hem = 0.875, armpit = 1.33, shoulder = 1.53;
};

/// Equal parts of [from, to], as long as `edge` about, behind what is there, which ends with `from`.
void add_parts(std::vector<Real>& places, Real to, Real edge) {
  const Real from = places.back();
  const auto count = std::max<Index>(1, static_cast<Index>(std::lround((to - from) / edge)));
  for (Index i = 1; i <= count; ++i)
    places.push_back(from + (to - from) * static_cast<Real>(i) / static_cast<Real>(count));
}

Real distance_to_segment(Real x, Real z, const std::array<Real, 4>& segment) {
  const auto [ax, az, bx, bz] = segment;
  const Real length = (bx - ax) * (bx - ax) + (bz - az) * (bz - az);
  const Real t = std::clamp<Real>(((x - ax) * (bx - ax) + (z - az) * (bz - az)) / length, 0, 1);
  return std::hypot(x - ax - t * (bx - ax), z - az - t * (bz - az));
}

/// How far the seams are [m].
Real distance_to_seam(Real x, Real z) {
  using O = Outline;
  const Real right = std::abs(x);
  return std::min({distance_to_segment(right, z, {O::neck, O::shoulder, O::cuff, O::shoulder}),
                   distance_to_segment(right, z, {O::side, O::armpit, O::cuff, O::armpit}),
                   distance_to_segment(right, z, {O::side, O::hem, O::side, O::armpit})});
}

/// Half of the depth of the shirt: round where it is sewn.
Real half_depth(Real x, Real z) {
  const Real most = 0.1 + 0.025 * std::clamp<Real>((0.2 - std::abs(x)) / 0.08, 0, 1);
  const Real t = 1 - std::min<Real>(1, distance_to_seam(x, z) / most);
  return most * std::sqrt(1 - t * t);
}

Mesh divided(const Mesh& mesh) {
  Mesh fine;
  std::map<std::array<Index, 2>, Index> middles;
  std::vector<Vec3> vertices;
  for (Index i = 0; i < mesh.vertex_count(); ++i) vertices.push_back(row(mesh.vertices, i));
  const auto middle = [&](Index a, Index b) {
    const auto [found, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)}, count_of(vertices));
    if (is_new) vertices.push_back((vertices[at(a)] + vertices[at(b)]) / 2);
    return found->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Triangle& each : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
      fine.triangles.push_back(each);
    }
  }
  fine.vertices.resize(count_of(vertices), 3);
  for (Index i = 0; i < count_of(vertices); ++i) fine.vertices.row(i) = vertices[at(i)].transpose();
  return fine;
}

/// About so long are the edges of the figure and its shirt together with so many vertices [m].
Real edge_for(Index vertices) {
  return std::sqrt(2.3 / static_cast<Real>(std::max<Index>(200, vertices)));
}

}  // namespace

Mesh shirt_mesh(Real edge) {
  using O = Outline;
  std::vector<Real> right{0}, z{O::hem};
  for (const Real to : {O::neck, O::side, O::cuff}) add_parts(right, to, edge);
  for (const Real to : {O::armpit, O::shoulder}) add_parts(z, to, edge);
  std::vector<Real> x;
  for (auto each = right.rbegin(); each + 1 != right.rend(); ++each) x.push_back(-*each);
  x.insert(x.end(), right.begin(), right.end());
  std::map<std::array<std::size_t, 3>, Index> numbers;  // of column, row and side
  std::vector<Vec3> vertices;
  Mesh mesh;
  const auto vertex = [&](std::size_t i, std::size_t j, std::size_t side) {
    const Real depth = half_depth(x[i], z[j]);
    const auto [found, is_new] = numbers.try_emplace({i, j, depth < 1e-9 ? 0 : side}, count_of(vertices));
    if (is_new) vertices.emplace_back(x[i], side == 0 ? -depth : depth, z[j]);
    return found->second;
  };
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    for (std::size_t j = 0; j + 1 < z.size(); ++j) {
      const bool is_sleeve = std::abs(x[i] + x[i + 1]) / 2 > O::side;
      if (is_sleeve && z[j + 1] < O::armpit + 1e-9) continue;
      for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
        const Index a = vertex(i, j, side), b = vertex(i + 1, j, side), c = vertex(i + 1, j + 1, side),
                    d = vertex(i, j + 1, side);
        const bool is_even = (i + j) % 2 == 0;
        std::array<Triangle, 2> pair{is_even ? Triangle{a, b, c} : Triangle{a, b, d},
                                     is_even ? Triangle{a, c, d} : Triangle{b, c, d}};
        for (Triangle& each : pair) {
          if (side == 1) std::swap(each[0], each[1]);
          mesh.triangles.push_back(each);
        }
      }
    }
  }
  mesh.vertices.resize(count_of(vertices), 3);
  for (Index i = 0; i < count_of(vertices); ++i) mesh.vertices.row(i) = vertices[at(i)].transpose();
  return mesh;
}

PairScene figure_in(const Mesh& shirt, const PairOptions& options) {
  PairScene scene{empty_simulation(options), 10};
  Figure figure = figure_mesh(edge_for(options.vertices));
  const Positions begin = figure.mesh.vertices;
  const BodyId body = scene.simulation.add_body(std::move(figure.mesh), Mass::area_density(1), {.name = "figure"});
  const GroupId pins = scene.simulation.add(body, Position{});
  add_cloth(scene.simulation, shirt);
  scene.move = moved(pins, begin, std::move(figure.part),
                     [turn = options.turn](Real time) { return figure_motions(time, turn); });
  finish(scene, options);
  return scene;
}

PairScene shirt(const PairOptions& options) {
  return figure_in(shirt_mesh(edge_for(options.vertices)), options);
}

PairScene tshirt(const PairOptions& options) {
  const std::filesystem::path file = std::filesystem::path(PLIANT_SOURCE_DIR) / "../shared/meshes/tshirt.obj";
  if (!std::filesystem::exists(file)) return shirt(options);
  Mesh mesh = read_mesh(file, {.scale = unit_of_file, .up = UpAxis::y});
  mesh.vertices.rowwise() += Vec3(0, 0.6 * unit_of_file, 0.8).transpose();
  return figure_in(options.vertices > 4000 ? divided(mesh) : mesh, options);
}

PairScene ball_and_curtain(const PairOptions& options) {
  const Index n = side_of(options.vertices, 1.5);
  PairScene scene{empty_simulation(options), 1};
  Simulation& simulation = scene.simulation;
  const BodyId cloth = add_cloth(simulation, sheet_mesh(n, 1, {-0.5, 0, -0.5}, Plane::xz));
  std::vector<Index> border;
  for (Index i = n * (n - 1); i < n * n; ++i) border.push_back(i);
  simulation.add(cloth, Position{.on = border});
  Mesh ball = sphere({.subdivisions = options.vertices < 1000 ? 2 : 3, .radius = 0.2});
  ball.vertices.rowwise() += Vec3(0.01, -0.3, -0.02).transpose();
  const Positions begin = ball.vertices;
  const BodyId body = simulation.add_body(std::move(ball), Mass::area_density(1), {.name = "ball"});
  const GroupId pins = simulation.add(body, Position{});
  const Real speed = options.speed > 0 ? options.speed : 5;
  std::vector<std::size_t> part(at(static_cast<Index>(begin.rows())), 0);
  scene.move = moved(pins, begin, std::move(part), [speed](Real time) {
    return std::array{Motion{.place = Vec3(0, std::min<Real>(0.9, speed * time), 0)}};
  });
  finish(scene, options);
  return scene;
}

PairScene sleeve(const PairOptions& options) {
  PairScene scene{empty_simulation(options), 0.5 + 2 * options.turn};
  Simulation& simulation = scene.simulation;
  const Real edge = std::sqrt(0.68 / static_cast<Real>(std::max<Index>(60, options.vertices)));
  const auto around = [&](Real radius) { return std::max<Index>(8, static_cast<Index>(2 * pi * radius / edge)); };
  const auto along_x = [](Mesh mesh, Real from) {
    for (Index i = 0; i < mesh.vertex_count(); ++i) {
      const Vec3 x = row(mesh.vertices, i);
      mesh.vertices.row(i) << from + x.z(), x.y(), -x.x();
    }
    return mesh;
  };
  const Mesh arm = along_x(capsule({.segments = around(0.05), .radius = 0.05, .height = 1}), 0);
  const BodyId body = simulation.add_body(arm, Mass::area_density(1), {.name = "arm"});
  const GroupId pins = simulation.add(body, Position{});
  const auto rows = std::max<Index>(4, static_cast<Index>(0.5 / edge) + 1);
  add_cloth(simulation,
            along_x(cylinder({.segments = around(0.08), .rows = rows, .radius = 0.08, .height = 0.5}), 0.4));
  std::vector<std::size_t> part(at(arm.vertex_count()), 0);
  scene.move = moved(pins, arm.vertices, std::move(part), [turn = options.turn](Real time) {
    return std::array{Motion{.rotation = turned(Vec3::UnitZ(), 2 * pi / turn * gone(time, 0.25, 2 * turn))}};
  });
  finish(scene, options);
  return scene;
}

}  // namespace pliant_tests
