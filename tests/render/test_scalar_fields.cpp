#include <doctest/doctest.h>

#include "../simulation/everything.h"
#include "../simulation/run.h"
#include "pliant/collision/colliders/builtin.h"
#include "render/annotations.h"
#include "render/scalar_fields.h"

namespace test_scalar_fields {

using namespace pliant_render;
using pliant::ColorBy;

namespace {

std::vector<Vec3f> floats(const pliant::Positions& x) {
  std::vector<Vec3f> result;
  for (Eigen::Index i = 0; i < x.rows(); ++i) result.push_back(x.row(i).transpose().cast<float>());
  return result;
}

}  // namespace

TEST_CASE("stretch is zero at rest, and the scale of a body that is larger in all directions") {
  const pliant::Simulation simulation = pliant_tests::everything({}, 8);
  const RenderMesh render_mesh = make_render_mesh(simulation.bodies());
  pliant::Positions rest(simulation.state().vertex_count(), 3);
  for (const pliant::Body& body : simulation.bodies()) {
    rest.middleRows(body.first_vertex, body.mesh.vertex_count()) = body.mesh.vertices;
  }
  for (const double scale : {1.0, 1.1, 0.7}) {
    const std::vector<float> stretch = vertex_stretch(render_mesh, floats(scale * rest));
    for (const float value : stretch) CHECK(value == doctest::Approx(scale - 1).epsilon(1e-5));
  }
}

TEST_CASE("the energies of the vertices sum to that of the simulation") {
  pliant::Simulation simulation = pliant_tests::everything({}, 8);
  pliant_tests::advance(simulation, 5);
  const double whole = simulation.evaluate().elastic;
  double sum = 0;
  for (const float energy : vertex_energy(simulation)) {
    CHECK(energy >= 0);
    sum += static_cast<double>(energy);
  }
  CHECK(whole > 0);
  CHECK(sum == doctest::Approx(whole).epsilon(1e-5));
}

TEST_CASE("gaps and forces of contact: what a sheet weighs goes through the one below into the floor") {
  pliant::Simulation simulation({.iterations = 30, .damping = 5});
  pliant::Mesh sheet = pliant::grid({.columns = 5, .rows = 5, .size = {0.4, 0.4}, .plane = pliant::Plane::xy});
  for (const double height : {0.02, 0.04, 5.0}) {
    sheet.vertices.col(2).setConstant(height);
    const auto body = simulation.add_body(sheet, pliant::Mass::total(0.2));
    simulation.add(body, pliant::TriangleStrain{.stiffness = 500});
    if (height == 5) simulation.add(body, pliant::Position{});
  }
  simulation.add(pliant::Gravity{});
  simulation.add(pliant::PlaneCollider{});
  simulation.set_contact({.distance = 0.02, .surfaces = true});
  CHECK(vertex_contact_force(simulation) == std::vector<float>(75, 0));
  pliant_tests::advance(simulation, 120);
  pliant::Vec3 on_low = pliant::Vec3::Zero(), on_top = pliant::Vec3::Zero();
  const std::vector<pliant::VertexTouch> touches = simulation.touches();
  for (std::size_t v = 0; v < 25; ++v) on_low += touches[v].force, on_top += touches[25 + v].force;
  CHECK(on_low.z() == doctest::Approx(0.2 * 9.81).epsilon(0.01));
  CHECK(on_top.z() == doctest::Approx(0.2 * 9.81).epsilon(0.01));
  const std::vector<float> gaps = vertex_gap(simulation);
  const std::vector<float> forces = vertex_contact_force(simulation);
  for (std::size_t v = 0; v < 75; ++v) {
    CAPTURE(v);
    CHECK(forces[v] == doctest::Approx(touches[v].force.norm()).epsilon(1e-6));
    if (v >= 50) {
      CHECK(gaps[v] == 0.02F);
      CHECK(forces[v] == 0);
    } else {
      CHECK(gaps[v] < 0.02F);
      CHECK(gaps[v] > 0.018F);
    }
  }
}

TEST_CASE("ranges begin at zero, or have it in the middle, and are never empty") {
  const std::vector<float> values = {0.2F, -0.5F, 0.1F};
  CHECK(field_range(ColorBy::stretch, values) == std::array<float, 2>{-0.5F, 0.5F});
  CHECK(field_range(ColorBy::speed, values) == std::array<float, 2>{0, 0.5F});
  CHECK(field_range(ColorBy::speed, {}) == std::array<float, 2>{0, 1});
  const std::vector<float> broken = {std::numeric_limits<float>::quiet_NaN(), 2};
  CHECK(field_range(ColorBy::energy, broken) == std::array<float, 2>{0, 2});
  const std::vector<float> extremes = {0, 1, 0, 100, 0, 2, 0, 0};
  CHECK(field_range(ColorBy::contact_force, extremes) == std::array<float, 2>{0, 2});
  CHECK(field_range(ColorBy::contact_force, {}) == std::array<float, 2>{0, 1});
}

TEST_CASE("ticks are round, ascend, lie in the range, and are three to six") {
  for (const float high : {1e-6F, 0.013F, 0.09F, 0.2F, 1.0F, 1.7F, 2.5F, 9.9F, 123.0F, 4e7F}) {
    for (const float low : {0.0F, -high}) {
      CAPTURE(low);
      CAPTURE(high);
      const std::vector<float> ticks = round_ticks(low, high);
      CHECK(ticks.size() >= 3);
      CHECK(ticks.size() <= 6);
      for (std::size_t i = 1; i < ticks.size(); ++i) CHECK(ticks[i] > ticks[i - 1]);
      CHECK(ticks.front() >= low * 1.001F - 1e-9F);
      CHECK(ticks.back() <= high * 1.001F);
      for (const float tick : ticks) {
        const std::string text = tick_text(tick, ticks[1] - ticks[0]);
        CAPTURE(text);
        CHECK(std::abs(std::stof(text) - tick) <= 1e-3F * std::abs(tick));  // says what it stands at
        CHECK(text.size() <= 9);
      }
    }
  }
  CHECK(round_ticks(3, 3).size() == 1);
  CHECK(round_ticks(1e9F, 1000000100.0F).size() <= 10);  // closer than floats there
  CHECK(round_ticks(1e30F, 2e30F).size() >= 3);
  CHECK(round_ticks(0, std::numeric_limits<float>::infinity()).size() == 1);
}

TEST_CASE("lightness rises evenly along the map of speeds, and falls to both ends of that of stretch") {
  const auto lightness = [](const std::array<std::uint8_t, 3>& c) { return 0.3 * c[0] + 0.59 * c[1] + 0.11 * c[2]; };
  const auto rising = color_map(ColorBy::speed);
  for (std::size_t i = 16; i < rising.size(); i += 16) CHECK(lightness(rising[i]) > lightness(rising[i - 16]));
  const auto both = color_map(ColorBy::stretch);
  for (std::size_t i = 16; i < both.size() / 2; i += 16) {
    CHECK(lightness(both[i]) > lightness(both[i - 16]));
    CHECK(lightness(both[both.size() - 1 - i]) > lightness(both[both.size() - 1 - i + 16]));
  }
}

}  // namespace test_scalar_fields
