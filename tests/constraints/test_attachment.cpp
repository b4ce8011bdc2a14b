// What ties bodies together: which points belong to each other, and that ties keep momentum and have no force at rest.
#include <numbers>

#include <doctest/doctest.h>

#include "../core/random.h"
#include "../simulation/run.h"
#include "pliant/constraints/attachment.h"
#include "pliant/constraints/bending.h"
#include "pliant/constraints/triangle_strain.h"
#include "pliant/core/error.h"
#include "pliant/mesh/nearest_face.h"
#include "pliant/mesh/shapes.h"
#include "tests/pairs/pair_scene.h"

namespace test_attachment {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr BodyId front{0}, back{1};

/// Two sheets side by side in the plane z = 0, with so many rows, of which the second begins where the first ends.
struct TwoSheets {
  explicit TwoSheets(const SolverSettings& settings, Index rows_of_second = 6, const Vec3& apart = {0.05, 0, 0})
      : simulation(settings), columns(5), rows(6), second_rows(rows_of_second) {
    Mesh first = grid({.columns = columns, .rows = rows, .size = {0.4, 0.5}, .plane = Plane::xy});
    Mesh second = grid({.columns = columns, .rows = second_rows, .size = {0.4, 0.5}, .plane = Plane::xy});
    second.vertices.rowwise() += (Vec3(0.4, 0, 0) + apart).transpose();
    simulation.add_body(first, Mass::area_density(0.2), {.name = "front"});
    simulation.add_body(second, Mass::area_density(0.2), {.name = "back"});
    for (const BodyId body : {front, back}) {
      simulation.add(body, TriangleStrain{.stiffness = 300});
      simulation.add(body, Bending{.stiffness = 1e-3});
    }
  }
  std::vector<Index> right_of_first() const { return column(columns - 1, rows); }
  std::vector<Index> left_of_second() const { return column(0, second_rows); }
  std::vector<Index> column(Index c, Index count) const {
    std::vector<Index> vertices;
    for (Index r = 0; r < count; ++r) vertices.push_back(r * columns + c);
    return vertices;
  }
  Attachment seam(AttachmentMode mode = AttachmentMode::seam) const {
    return {.on = right_of_first(), .to = back, .to_on = left_of_second(), .mode = mode};
  }

  Simulation simulation;
  Index columns, rows, second_rows;
};

struct Momentum {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
};

Momentum momentum(const State& state) {
  Momentum sum;
  for (Index v = 0; v < state.vertex_count(); ++v) {
    const Vec3 p = state.masses[static_cast<std::size_t>(v)] * row(state.velocities, v);
    sum.linear += p;
    sum.angular += row(state.positions, v).cross(p);
  }
  return sum;
}

std::string refusal(Simulation& simulation, BodyId body, const Attachment& attachment) {
  try {
    simulation.add(body, attachment);
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::input);
    return error.what();
  }
  return "(no error)";
}

bool has(const std::string& text, std::string_view part) {
  CAPTURE(text);
  CAPTURE(part);
  return text.find(part) != text.npos;
}

Positions random_velocities(Index count, Real size) {
  Random random;
  Positions v = random.positions(count, size);
  return v;
}

}  // namespace

TEST_CASE("two free bodies keep their momentum while they are sewn together") {
  for (const AttachmentMode mode : {AttachmentMode::nearest_vertex, AttachmentMode::nearest_face, AttachmentMode::seam,
                                    AttachmentMode::seam_by_length}) {
    CAPTURE(static_cast<int>(mode));
    TwoSheets sheets(converged(1e-13), 6, {0.05, 0.01, 0.02});
    Simulation& simulation = sheets.simulation;
    Attachment attachment = sheets.seam(mode);
    if (mode == AttachmentMode::nearest_face) attachment.to_on = {};
    if (mode != AttachmentMode::nearest_vertex) attachment.closing_time = 0.1;
    const GroupId seam = simulation.add(front, attachment);
    simulation.set_state(simulation.state().positions, random_velocities(simulation.state().vertex_count(), 0.5));
    const Momentum first = momentum(simulation.state());
    for (int i = 0; i < 10; ++i) {
      const State before = simulation.state();
      simulation.step();
      const Momentum now = momentum(simulation.state());
      CHECK((now.linear - first.linear).norm() <= 1e-9 * first.linear.norm());
      // Implicit Euler itself turns the body by h v' × m v; the torque of all forces is what is left.
      Vec3 torque = now.angular - momentum(before).angular;
      for (Index v = 0; v < before.vertex_count(); ++v) {
        torque -= before.masses[static_cast<std::size_t>(v)] / 60 *
                  row(simulation.state().velocities, v).cross(row(before.velocities, v));
      }
      CHECK(torque.norm() <= 1e-9 * first.angular.norm());
    }
    simulation.evaluate();
    CHECK(simulation.elastic_energy(seam) > 0);
  }
}

TEST_CASE("a seam at rest has exactly no force, whatever it ties") {
  for (const AttachmentMode mode : {AttachmentMode::nearest_vertex, AttachmentMode::nearest_face, AttachmentMode::seam,
                                    AttachmentMode::seam_by_length}) {
    for (const Index rows : {6, 8}) {
      if (mode == AttachmentMode::seam && rows != 6) continue;
      CAPTURE(static_cast<int>(mode));
      CAPTURE(rows);
      TwoSheets sheets({.threads = 1}, rows, {0, 0, 0});
      Attachment attachment = sheets.seam(mode);
      if (mode == AttachmentMode::nearest_face) attachment.to_on = {};
      if (mode == AttachmentMode::nearest_vertex && rows != 6) attachment.keep_distance = true;
      const GroupId seam = sheets.simulation.add(front, attachment);
      CHECK(sheets.simulation.groups().at(seam).set.count == std::max(Index{6}, is_seam(mode) ? rows : 0));
      sheets.simulation.evaluate();
      CHECK(sheets.simulation.elastic_energy(seam) == 0);
      const Positions before = sheets.simulation.state().positions;
      for (const auto& [id, group] : sheets.simulation.groups()) {
        if (id != seam) continue;
        for (const auto& batch : group.set.batches) {
          std::vector<Real> out(3 * static_cast<std::size_t>(batch->shape().count), 7);
          CHECK(batch->project(before, out, 0, batch->shape().count) == 0);
          for (const Real number : out) CHECK(number == 0);
        }
      }
    }
  }
}

TEST_CASE("ties shorten to their end in the time given, and hold") {
  TwoSheets sheets({.iterations = 40, .threads = 1}, 6, {0.1, 0, 0});
  Simulation& simulation = sheets.simulation;
  Attachment attachment = sheets.seam();
  attachment.closing_time = 0.5;
  attachment.stiffness = 1e5;
  simulation.add(front, attachment);
  const Index a = simulation.vertex(front, sheets.right_of_first()[2]);
  const Index b = simulation.vertex(back, sheets.left_of_second()[2]);
  const auto gap = [&] { return (row(simulation.state().positions, a) - row(simulation.state().positions, b)).norm(); };
  for (int i = 1; i <= 60; ++i) {
    simulation.step();
    const Real wanted = std::max<Real>(0, 0.1 * (1 - simulation.state().time / 0.5));
    CHECK(gap() <= wanted + 2e-3);
    if (i == 15) CHECK(gap() >= 0.03);
  }
  CHECK(gap() < 1e-4);
}

TEST_CASE("a seam that closes brings in no more energy than its motion needs, where energy is kept") {
  // Both sheets come nearer at 0.05 m/s each: m v²/2 is 0.1 mJ, and what they swing afterwards is a few times that.
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    CAPTURE(static_cast<int>(integrator));
    TwoSheets sheets({.integrator = integrator, .iterations = 20, .energy_projection = 1, .threads = 1}, 6,
                     {0.1, 0, 0});
    Attachment attachment = sheets.seam();
    attachment.closing_time = 1;
    const GroupId seam = sheets.simulation.add(front, attachment);
    Real most = 0;
    for (int i = 0; i < 120; ++i) {
      sheets.simulation.step();
      sheets.simulation.evaluate();
      const State& state = sheets.simulation.state();
      Real energy = 0;
      for (Index v = 0; v < state.vertex_count(); ++v) {
        energy += state.masses[static_cast<std::size_t>(v)] / 2 * row(state.velocities, v).squaredNorm();
      }
      for (const auto& [id, group] : sheets.simulation.groups()) energy += sheets.simulation.elastic_energy(id);
      most = std::max(most, energy);
    }
    CHECK(sheets.simulation.groups().contains(seam));
    CHECK(most > 1e-4);
    CHECK(most < 5e-3);
  }
}

TEST_CASE("a tie of some length is slack below it") {
  TwoSheets sheets({.iterations = 30, .threads = 1}, 6, {0.05, 0, 0});
  Simulation& simulation = sheets.simulation;
  Attachment attachment = sheets.seam();
  attachment.length = 0.06;
  const GroupId seam = simulation.add(front, attachment);
  const Positions before = simulation.state().positions;
  advance(simulation, 5);
  CHECK(simulation.elastic_energy(seam) == 0);
  CHECK(largest_difference(simulation.state().positions, before) < 1e-12);
  Attachment kept = sheets.seam();
  kept.keep_distance = true;
  simulation.replace(seam, kept);
  advance(simulation, 5);
  CHECK(largest_difference(simulation.state().positions, before) < 1e-12);
}

TEST_CASE("loops of unlike numbers of vertices meet all the way round") {
  // Two rims of tubes, the finer one turned by an angle that fits no vertex.
  const auto ring = [](Index count, Real turned, Real z) {
    Mesh mesh;
    mesh.vertices.resize(2 * count, 3);
    for (Index i = 0; i < count; ++i) {
      const Real angle = turned + 2 * std::numbers::pi * static_cast<Real>(i) / static_cast<Real>(count);
      mesh.vertices.row(i) = Vec3(std::cos(angle), std::sin(angle), z).transpose();
      mesh.vertices.row(count + i) = Vec3(std::cos(angle), std::sin(angle), z + (z > 0 ? 1 : -1)).transpose();
      const Index next = (i + 1) % count;
      mesh.triangles.push_back({i, next, count + i});
      mesh.triangles.push_back({next, count + next, count + i});
    }
    return mesh;
  };
  const auto rim = [](Index count) {
    std::vector<Index> vertices;
    for (Index i = 0; i < count; ++i) vertices.push_back((7 * i) % count);  // in no order
    return vertices;
  };
  Simulation simulation;
  simulation.add_body(ring(20, 0, 0.01), Mass::total(1));
  simulation.add_body(ring(33, 0.4321, -0.01), Mass::total(1));
  const GroupId seam = simulation.add(
      front, Attachment{.on = rim(20), .to = back, .to_on = rim(33), .mode = AttachmentMode::seam_by_length});
  const ConstraintSet& set = simulation.groups().at(seam).set;
  CHECK(set.count == 33);
  Real length = 0;
  for (const auto& batch : set.batches) {
    for (const Real measure : batch->rest_measure()) length += measure;
    std::vector<Real> z(3 * static_cast<std::size_t>(batch->shape().count));
    batch->project(simulation.state().positions, z, 0, batch->shape().count);
    for (std::size_t i = 0; i < z.size(); i += 3) {
      const Real force = Vec3(z[i], z[i + 1], z[i + 2]).norm() / batch->rest_measure()[i / 3] / batch->stiffness();
      CHECK(force < 0.06);  // 0.02 m apart, and the chord of 20 edges is 0.012 m inside
    }
  }
  CHECK(length == doctest::Approx(33 * 2 * std::sin(std::numbers::pi / 33)));
}

TEST_CASE("one panel becomes a tube, and a dart closes at its tip") {
  Simulation simulation;
  simulation.add_body(grid({.columns = 5, .rows = 4, .plane = Plane::xy}), Mass::total(1));
  const Attachment tube{.on = {0, 5, 10, 15}, .to = front, .to_on = {4, 9, 14, 19}, .mode = AttachmentMode::seam};
  const GroupId seam = simulation.add(front, tube);
  CHECK(simulation.groups().at(seam).set.count == 4);
  const Attachment dart{.on = {2, 7, 12}, .to = front, .to_on = {4, 8, 12}, .mode = AttachmentMode::seam};
  CHECK(has(refusal(simulation, front, dart), "make no single chain"));  // 4 and 8 are joined by no edge
  const Attachment both{.on = {2, 7, 12}, .to = front, .to_on = {0, 6, 12}, .mode = AttachmentMode::seam};
  const GroupId closed = simulation.add(front, both);
  CHECK(simulation.groups().at(closed).set.count == 2);  // the tip is on both sides
}

TEST_CASE("what cannot be tied is refused with the remedy") {
  TwoSheets sheets({.threads = 1}, 8);
  Simulation& simulation = sheets.simulation;
  std::string text = refusal(simulation, front, sheets.seam());
  CHECK(
      has(text, "attachment of body 'front' to body 'back': 'from' selects a chain of 6 vertices, 'to' a chain of 8"));
  CHECK(has(text, "use mode 'seam_by_length'"));

  Attachment attachment = sheets.seam();
  attachment.on = {0, 3};
  CHECK(has(refusal(simulation, front, attachment), "the 2 vertices that 'from' selects make no single chain"));
  attachment.on = {0, 0};
  CHECK(has(refusal(simulation, front, attachment), "'from' names vertex 0 twice"));
  attachment.on = {0, 30};
  CHECK(
      has(refusal(simulation, front, attachment), "vertex 30, which is out of range; body 'front' has vertices 0 to"));
  attachment.on = Selection(std::vector<Index>{});
  CHECK(has(refusal(simulation, front, attachment), "'from' selects no vertex"));
  attachment.to = BodyId{5};
  CHECK(has(refusal(simulation, front, attachment), "body 5 does not exist"));

  Attachment self{.on = {0, 1}, .to = front, .to_on = {1, 2}};
  CHECK(has(refusal(simulation, front, self), "vertex 1 would be tied to itself"));
  self = {.on = {0}, .to = front, .mode = AttachmentMode::nearest_face};
  CHECK(has(refusal(simulation, front, self), "vertex 0 would be tied to a face of its own"));
  self = {.on = {0, 1}, .to = front, .to_on = {0, 1}, .mode = AttachmentMode::seam};
  CHECK(has(refusal(simulation, front, self), "both sides are the same vertices"));

  const BodyId rope = simulation.add_body(chain({.links = 3}), Mass::total(1), {.name = "rope"});
  text = refusal(simulation, front, {.on = {0}, .to = rope, .mode = AttachmentMode::nearest_face});
  CHECK(has(text, "body 'rope' has no triangle at all"));
  text = refusal(simulation, front, {.on = {0}, .to = back, .to_on = {0, 1}, .mode = AttachmentMode::nearest_face});
  CHECK(has(text, "has no triangle whose corners are all selected by 'to'"));
  text = refusal(simulation, front, {.on = {0}, .to = back, .length = 1, .keep_distance = true});
  CHECK(has(text, "'keep_distance' and 'length'"));
  text = refusal(simulation, front, {.on = {0}, .to = back, .stiffness = -1});
  CHECK(has(text, "stiffness"));
  text = refusal(simulation, front, {.on = {0, 1}, .to = back, .stiffness = Values({1, 2, 3})});
  CHECK(has(text, "stiffness has 3 entries for 2"));
}

TEST_CASE("a seam is as stiff on a fine mesh as on a coarse one") {
  Real energies[2] = {};
  for (const Index refined : {0, 1}) {
    const Index rows = refined == 0 ? 6 : 11;
    Simulation simulation;
    Mesh first = grid({.columns = 3, .rows = rows, .plane = Plane::xy}), second = first;
    second.vertices.rowwise() += Vec3(1.1, 0, 0).transpose();
    simulation.add_body(first, Mass::total(1));
    simulation.add_body(second, Mass::total(1));
    std::vector<Index> right, left;
    for (Index r = 0; r < rows; ++r) right.push_back(3 * r + 2), left.push_back(3 * r);
    const GroupId seam =
        simulation.add(front, Attachment{.on = right, .to = back, .to_on = left, .mode = AttachmentMode::seam});
    simulation.evaluate();
    energies[refined] = simulation.elastic_energy(seam);
  }
  CHECK(energies[0] == doctest::Approx(0.5 * Attachment::usual_seam_stiffness * 0.01));  // 1 m of seam, 0.1 m open
  CHECK(energies[1] == doctest::Approx(energies[0]).epsilon(1e-12));
}

TEST_CASE("the nearest point of a surface is that of a search of all triangles") {
  Random random;
  const Mesh mesh = sphere({.subdivisions = 2});
  const NearestFace nearest(mesh.vertices, mesh.triangles);
  for (int i = 0; i < 500; ++i) {
    const Vec3 place = random.vector(2);
    const FacePoint found = nearest(place);
    FacePoint best;
    best.squared = 1e300;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Triangle& c = mesh.triangles[t];
      const FacePoint point =
          nearest_point(place, {row(mesh.vertices, c[0]), row(mesh.vertices, c[1]), row(mesh.vertices, c[2])});
      if (point.squared < best.squared) best = point;
    }
    CHECK(found.squared == best.squared);
    Vec3 y = Vec3::Zero();
    const Triangle& c = mesh.triangles[static_cast<std::size_t>(found.triangle)];
    for (std::size_t j = 0; j < 3; ++j) y += found.weights[j] * row(mesh.vertices, c[j]);
    CHECK((y - place).squaredNorm() == doctest::Approx(found.squared));
  }
}

TEST_CASE("the nearest point of a triangle, degenerate ones too, is nearer than all others") {
  Random random;
  for (int i = 0; i < 2000; ++i) {
    std::array<Vec3, 3> corners = {random.vector(1), random.vector(1), random.vector(1)};
    if (i % 4 == 1) corners[2] = corners[0] + random.uniform(-1, 2) * (corners[1] - corners[0]);
    if (i % 4 == 2) corners[1] = corners[0];
    if (i % 8 == 3) corners[1] = corners[2] = corners[0];
    const Vec3 place = random.vector(2);
    const FacePoint found = nearest_point(place, corners);
    CHECK(found.weights[0] + found.weights[1] + found.weights[2] == doctest::Approx(1));
    for (int k = 0; k < 100; ++k) {
      Real a = random.uniform(0, 1), b = random.uniform(0, 1);
      if (a + b > 1) a = 1 - a, b = 1 - b;
      const Vec3 y = (1 - a - b) * corners[0] + a * corners[1] + b * corners[2];
      CHECK((y - place).squaredNorm() >= found.squared - 1e-9);
    }
  }
}

// What the scenes of contact are held to: an edge that is tied to a vertex is its neighbor, as on one mesh.
TEST_CASE("crossings beside a tie do not count, others do") {
  Simulation simulation(SolverSettings{.threads = 1});
  const Mesh sheet = grid({.columns = 5, .rows = 6, .size = {0.4, 0.5}, .plane = Plane::xy});
  const Vec3 corner = sheet.vertices.row(2 * 5 + 2).transpose();
  Mesh lines;
  lines.vertices.resize(4, 3);
  lines.vertices << (corner - Vec3(0, 0, 5e-4)).transpose(), (corner + Vec3(0.01, 0.005, 0.3)).transpose(), 0.05, 0.33,
      -0.1, 0.06, 0.33, 0.1;
  lines.edges = {{0, 1}, {2, 3}};
  simulation.add_body(sheet, Mass::area_density(0.2), {.name = "sheet"});
  const BodyId rope = simulation.add_body(lines, Mass::per_vertex(0.01), {.name = "lines"});
  simulation.set_contact(ContactSettings{.distance = 0.005});
  CHECK(count_crossings(simulation) == 2);
  simulation.add(rope, Attachment{.on = std::vector<Index>{0}, .to = front, .mode = AttachmentMode::nearest_vertex});
  CHECK(count_crossings(simulation) == 1);
}

}  // namespace test_attachment
