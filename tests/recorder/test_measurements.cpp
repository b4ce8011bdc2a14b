// What is measured agrees with closed forms, and its file reads back.
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>

#include <doctest/doctest.h>

#include "pliant/collision/colliders/builtin.h"
#include "pliant/constraints/edge_spring.h"
#include "pliant/constraints/fibre_strain.h"
#include "pliant/constraints/position.h"
#include "pliant/constraints/triangle_strain.h"
#include "pliant/forces/builtin.h"
#include "pliant/mesh/shapes.h"
#include "pliant_io/files/number_text.h"
#include "pliant_io/recorder/recorder.h"
#include "tests/support/temporary_folder.h"

namespace test_measurements {

namespace {

using namespace pliant;
using pliant_tests::TemporaryFolder;

constexpr Real h = 1.0 / 60;

/// The columns of a CSV file without quoted fields.
std::map<std::string, std::vector<Real>> read_columns(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  std::vector<std::string> names;
  std::map<std::string, std::vector<Real>> columns;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string field;
    for (std::size_t i = 0; std::getline(fields, field, ','); ++i) {
      if (!columns.contains("step")) {
        names.push_back(field);
        continue;
      }
      Real number = 0;
      const auto result = number_from_chars(field.data(), field.data() + field.size(), number);
      CHECK(result.ec == std::errc());
      CHECK(result.ptr == field.data() + field.size());
      REQUIRE(i < names.size());
      columns[names[i]].push_back(number);
    }
    for (const std::string& name : names) columns[name];
  }
  return columns;
}

TEST_CASE("free fall: implicit Euler's loss of energy in closed form") {
  // vₙ = −g h n, zₙ = z₀ − g h² n(n + 1)/2, so E(n) − E(0) = −m g² h² n/2.
  Simulation simulation;
  simulation.add_body(grid({.columns = 4, .rows = 4}), Mass::total(3));
  simulation.add(Gravity{});
  const Real start = measure(simulation, {}).total;
  for (int n = 1; n <= 50; ++n) {
    const Measurements row = measure(simulation, simulation.step());
    CHECK(row.step == n);
    CHECK(std::abs(row.kinetic - 1.5 * std::pow(9.81 * h * n, 2)) < 1e-12 * row.kinetic);
    CHECK(std::abs(row.total - (start - 1.5 * 9.81 * 9.81 * h * h * n)) < 1e-11 * (1 + row.kinetic));
    CHECK(std::abs(row.speed_sum - 16 * 9.81 * h * n) < 1e-10);
    CHECK((row.momentum - Vec3(0, 0, -3 * 9.81 * h * n)).norm() < 1e-11);
  }
}

TEST_CASE("elastic energy, momenta and residual of a spring drawn apart") {
  Simulation simulation({.time_step = 0.01, .iterations = 1});
  Mesh rod;
  rod.vertices = Positions{{0, 0, 0}, {1, 0, 0}};
  rod.edges = {{0, 1}};
  BodyOptions options;
  options.start = Positions{{0, 0, 0}, {1.5, 0, 0}};
  options.velocities = Positions{{0, 2, 0}, {0, 0, 3}};
  const BodyId body = simulation.add_body(rod, Mass::each({2, 4}), options);
  simulation.add(body, EdgeSpring{.stiffness = 100}, "spring");
  const Measurements row = measure(simulation, {});
  REQUIRE(row.elastic.size() == 1);
  CHECK(std::abs(row.elastic[0] - 0.5 * 100 * 0.25) < 1e-13);
  CHECK(row.kinetic == 2 * 4 / 2.0 + 4 * 9 / 2.0);
  CHECK(row.gravitational == 0);
  CHECK(row.total == row.kinetic + row.elastic[0]);
  CHECK(row.momentum == Vec3(0, 4, 12));
  CHECK(row.angular_momentum == Vec3(0, -18, 0));
  CHECK(row.speed_sum == 5);
}

TEST_CASE("the energies of a row add up to its total, under pressure too") {
  const TemporaryFolder folder;
  Simulation simulation;
  const Mesh tube = torus({});
  const BodyId body = simulation.add_body(tube, Mass::total(1));
  simulation.add(body, TriangleStrain{.stiffness = 200}, "skin");
  simulation.add(body, EdgeSpring{.stiffness = 5}, "springs");
  simulation.add(Gravity{});
  simulation.add(Pressure{.pressure = 20});
  Recorder recorder(folder.path(), nullptr, 1, simulation.group_names());
  for (int i = 0; i < 5; ++i) recorder.record(simulation, simulation.step());
  const auto columns = read_columns(TemporaryFolder::read(folder.path() / "measurements.csv"));
  REQUIRE(columns.at("total").size() == 5);
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(std::abs(columns.at("other_potential")[i]) > 1e-6);  // the volume has changed
    Real sum = 0;
    Real size = 0;
    for (const char* name : {"kinetic", "elastic_skin", "elastic_springs", "gravitational", "other_potential"}) {
      sum += columns.at(name)[i];
      size += std::abs(columns.at(name)[i]);
    }
    CHECK(std::abs(columns.at("total")[i] - sum) <= 1e-14 * size);
  }
}

TEST_CASE("how far stretches are past their limits is the largest excess of all strains") {
  const auto past_limits = [](auto... strains) {
    Simulation simulation;
    const Mesh sheet = grid({.columns = 40, .rows = 40, .plane = Plane::xy});
    BodyOptions options;
    options.start = sheet.vertices * Vec3(1.25, 1.125, 1).asDiagonal();
    const BodyId body = simulation.add_body(sheet, Mass::total(1), options);
    simulation.add(body, EdgeSpring{.stiffness = 5});
    (simulation.add(body, strains), ...);
    return measure(simulation, {}).past_limits;
  };
  const auto approx = [](Real x) { return doctest::Approx(x).epsilon(1e-12); };
  CHECK(past_limits() == 0);
  CHECK(past_limits(FibreStrain{.direction = Vec3(1, 0, 0)}) == approx(0.25));
  CHECK(past_limits(FibreStrain{.direction = Vec3(0, 1, 0), .stiffness = 1e6, .max_stretch = 1.025}) == approx(0.1));
  CHECK(past_limits(FibreStrain{.direction = Vec3(1, 0, 0), .taut_factor = 30}) == approx(0.25));
  CHECK(past_limits(FibreStrain{.direction = Vec3(1, 0, 0), .slack_factor = 0.005, .taut_onset = 1.0}) == approx(0.25));
  CHECK(past_limits(FibreStrain{.direction = Vec3(1, 0, 0), .max_stretch = 1.1, .taut_factor = 3, .taut_stretch = 1.2},
                    FibreStrain{.direction = Vec3(0, 1, 0), .min_stretch = 1.3, .max_stretch = 1.3}) == approx(0.175));
  CHECK(past_limits(TriangleStrain{.stiffness = 3, .max_stretch = 1.2}) == approx(0.05));
  CHECK(past_limits(TriangleStrain{.max_stretch = 1.5}) == 0);
  CHECK(past_limits(TriangleStrain{}) == approx(std::hypot(0.25, 0.125)));
  CHECK(past_limits(TriangleStrain{}, FibreStrain{.direction = Vec3(0, 1, 0)}) == approx(0.125));
}

TEST_CASE("a force says which potential it has; its name decides nothing") {
  class Tide final : public Force {
   public:
    explicit Tide(PotentialKind kind) : kind_(kind) {}
    std::string_view type() const override { return "gravity"; }
    void add_to(Positions&, const StateView&, Real) override {}
    Real potential(const StateView&) const override { return kind_ == PotentialKind::gravitational ? 3 : 5; }
    PotentialKind potential_kind() const override { return kind_; }

   private:
    PotentialKind kind_;
  };
  Simulation simulation;
  simulation.add_body(grid({.columns = 2, .rows = 2}), Mass::total(1));
  simulation.add_force(std::make_unique<Tide>(PotentialKind::gravitational));
  simulation.add_force(std::make_unique<Tide>(PotentialKind::other));
  const Measurements row = measure(simulation, {});
  CHECK(row.gravitational == 3);
  CHECK(row.other_potential == 5);
  CHECK(row.total == 8);
}

TEST_CASE("the file has a row for each record, and numbers that read back to the same bits") {
  const TemporaryFolder folder;
  Simulation simulation;
  const BodyId body = simulation.add_body(grid({.columns = 4, .rows = 4}), Mass::total(1));
  simulation.add(body, EdgeSpring{.stiffness = 50}, "springs");
  simulation.add(body, Position{.on = {12, 15}}, "pins, hard");
  simulation.add(Gravity{});
  Recorder recorder(folder.path(), make_npy_writer(folder.path(), 16), 3, simulation.group_names());
  recorder.record(simulation, {});
  std::vector<Measurements> rows = {measure(simulation, {})};
  for (int i = 1; i <= 10; ++i) {
    const StepReport report = simulation.step();
    recorder.record(simulation, report);
    if (i % 3 == 0) rows.push_back(measure(simulation, report));
  }
  CHECK(recorder.frame_count() == 4);
  std::string text = TemporaryFolder::read(folder.path() / "measurements.csv");
  const std::size_t quoted = text.find("\"elastic_pins, hard\"");
  REQUIRE(quoted != text.npos);
  text.replace(quoted, 20, "elastic_pins");
  const auto columns = read_columns(text);
  CHECK(columns.size() == 20);
  for (const auto& column : columns) {
    CAPTURE(column.first);
    REQUIRE(column.second.size() == rows.size());
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CHECK(columns.at("step")[i] == 3.0 * static_cast<Real>(i));
    CHECK(columns.at("time")[i] == rows[i].time);
    CHECK(columns.at("kinetic")[i] == rows[i].kinetic);
    CHECK(columns.at("elastic_springs")[i] == rows[i].elastic[0]);
    CHECK(columns.at("elastic_pins")[i] == 0);
    CHECK(columns.at("gravitational")[i] == rows[i].gravitational);
    CHECK(columns.at("total")[i] == rows[i].total);
    CHECK(columns.at("momentum")[i] == rows[i].momentum.norm());
    CHECK(columns.at("angular_momentum_y")[i] == rows[i].angular_momentum[1]);
    CHECK(columns.at("residual")[i] == rows[i].residual);
    CHECK(columns.at("objective")[i] == rows[i].objective);
    CHECK(columns.at("iterations")[i] == (i == 0 ? 0 : 10));
  }
  CHECK(columns.at("residual")[3] > 0);
}

TEST_CASE("groups that come and go have columns from the start, and 0 where they are not") {
  const TemporaryFolder folder;
  Simulation simulation;
  const BodyId body = simulation.add_body(grid({.columns = 3, .rows = 3}), Mass::total(1));
  const GroupId springs = simulation.add(body, EdgeSpring{.stiffness = 50}, "springs");
  simulation.add(Gravity{});
  Recorder recorder(folder.path(), nullptr, 1, {"springs", "skin"});
  const auto step = [&] { recorder.record(simulation, simulation.step()); };
  recorder.record(simulation, {});
  simulation.add(body, Position{.on = {6}, .hold = Hold::soft, .stiffness = 70}, "unannounced");
  step();
  const GroupId skin = simulation.add(body, TriangleStrain{.stiffness = 20}, "skin");
  simulation.remove(springs);
  step();
  simulation.remove(skin);
  simulation.add(body, EdgeSpring{.stiffness = 5}, "springs");
  step();
  const auto columns = read_columns(TemporaryFolder::read(folder.path() / "measurements.csv"));
  CHECK(columns.size() == 20);
  const std::vector<Real>& of_springs = columns.at("elastic_springs");
  const std::vector<Real>& of_skin = columns.at("elastic_skin");
  REQUIRE(of_springs.size() == 4);
  CHECK(of_springs[1] > 0);
  CHECK(of_springs[2] == 0);
  CHECK(of_springs[3] > 0);
  CHECK(of_skin[1] == 0);
  CHECK(of_skin[2] > 0);
  CHECK(of_skin[3] == 0);
}

TEST_CASE("colliders have columns of contact, and the forces on them add up to those on the bodies") {
  const TemporaryFolder folder;
  Simulation simulation({.time_step = 0.01, .iterations = 100});
  const BodyId body = simulation.add_body(grid({.columns = 3, .rows = 3, .plane = Plane::xy}), Mass::total(2));
  simulation.add(body, EdgeSpring{.stiffness = 50}, "springs");
  simulation.add(Gravity{});
  simulation.add(PlaneCollider{.position = {0, 0, -0.01}, .friction = 0.5}, "floor, flat");
  Recorder recorder(folder.path(), nullptr, 1, simulation.group_names(), 0, {.colliders = {"floor, flat", "ball"}});
  recorder.record(simulation, {});
  for (int i = 0; i < 300; ++i) recorder.record(simulation, simulation.step());
  const ColliderId ball = simulation.add(SphereCollider{.center = {5, 5, 5}}, "ball");
  recorder.record(simulation, simulation.step());
  simulation.remove(ball);
  recorder.record(simulation, simulation.step());
  std::string text = TemporaryFolder::read(folder.path() / "measurements.csv");
  const std::string header = text.substr(0, text.find('\n'));
  CHECK(header.find("ms_total,contacts,deepest,friction_power,held_back,backtracks,refactorizations,ms_contact,"
                    "\"force_x_floor, flat\",") != std::string::npos);
  CHECK(header.ends_with(",force_x_ball,force_y_ball,force_z_ball,torque_x_ball,torque_y_ball,torque_z_ball"));
  for (std::size_t at = 0; (at = text.find("\"", at)) != text.npos;) text.erase(at, 1);
  for (std::size_t at = 0; (at = text.find("floor, flat", at)) != text.npos;) text.replace(at, 11, "floor");
  const auto columns = read_columns(text);
  const auto last = [&](const char* name) { return columns.at(name).back(); };
  CHECK(last("contacts") == 9);
  CHECK(last("deepest") > 0);
  CHECK(last("ms_contact") > 0);
  CHECK(last("ms_contact") < last("ms_total"));
  CHECK(columns.at("force_z_floor").front() == 0);
  CHECK(std::abs(last("force_z_floor") + 2 * 9.81) < 1e-3);  // it carries the sheet
  Vec3 force = Vec3::Zero();
  for (const ContactPoint& point : simulation.contacts()) force += point.force;
  CHECK(std::abs(force.z() + last("force_z_floor")) < 1e-12 * force.norm());
  CHECK(columns.at("force_z_ball") == std::vector<Real>(columns.at("step").size(), 0));
  CHECK(header.find("smallest_gap") == std::string::npos);
}

TEST_CASE("surfaces that touch have columns of their pairs, without a collider too") {
  const TemporaryFolder folder;
  Simulation simulation({.iterations = 20});
  Mesh sheet = grid({.columns = 3, .rows = 3, .plane = Plane::xy});
  simulation.add(simulation.add_body(sheet, Mass::total(1)), Position{});
  sheet.vertices.col(2).array() += 1;
  simulation.add(simulation.add_body(sheet, Mass::total(1)), EdgeSpring{.stiffness = 50});
  simulation.add(Gravity{});
  simulation.set_contact({.distance = 0.05, .surfaces = true});
  Recorder recorder(folder.path(), nullptr, 1, simulation.group_names(), 0, {.surfaces = true});
  recorder.record(simulation, {});
  for (int i = 0; i < 60; ++i) recorder.record(simulation, simulation.step());
  const auto columns = read_columns(TemporaryFolder::read(folder.path() / "measurements.csv"));
  CHECK(std::isinf(columns.at("smallest_gap")[5]));  // far above
  CHECK(columns.at("active")[5] == 0);
  CHECK(columns.at("pairs").back() >= columns.at("active").back());
  CHECK(columns.at("active").back() > 0);
  CHECK(columns.at("smallest_gap").back() > 0);
  CHECK(columns.at("smallest_gap").back() < 0.05);
  CHECK(columns.at("shortened").front() == 0);
  CHECK(columns.at("momentum_lost").back() < 1e-5);  // of 0.16 N s that weight gives in a step
  CHECK(columns.at("energy_taken").back() < 1e-6);
  CHECK(columns.at("lag").back() == 0);
  CHECK(columns.at("let_go").back() == 0);
  CHECK(columns.at("ms_contact").back() > 0);
}

TEST_CASE("crossings and the lag of pins have columns") {
  const TemporaryFolder folder;
  Simulation simulation;
  const Mesh sheet = grid({.columns = 5, .rows = 5, .plane = Plane::xy});
  Mesh upright = grid({.columns = 5, .rows = 5, .size = {0.5, 0.5}});
  upright.vertices.rowwise() += Vec3(0.22, 0.51, -0.23).transpose();
  Mesh above = sheet;
  above.vertices.col(2).array() += 0.4;
  simulation.add(simulation.add_body(sheet, Mass::total(1)), Position{});
  simulation.add(simulation.add_body(upright, Mass::total(0.1)), EdgeSpring{.stiffness = 50});
  Mesh between = above;
  between.vertices.col(2).array() -= 0.1;
  simulation.add(simulation.add_body(between, Mass::total(1)), EdgeSpring{.stiffness = 50});
  const BodyId block = simulation.add_body(above, Mass::total(1));
  const GroupId pins = simulation.add(block, Position{});
  simulation.set_contact({.surfaces = true});
  Recorder recorder(folder.path(), nullptr, 1, simulation.group_names(), 0, {.surfaces = true});
  recorder.record(simulation, {});
  for (int i = 0; i < 25; ++i) {
    for (Index v = 0; v < above.vertex_count(); ++v) {
      simulation.set_target(pins, v, row(above.vertices, v) - 0.02 * (i + 1) * Vec3::UnitZ());
    }
    recorder.record(simulation, simulation.step());
  }
  const auto columns = read_columns(TemporaryFolder::read(folder.path() / "measurements.csv"));
  CHECK(columns.at("let_go").front() == 0);  // nothing has been looked for
  CHECK(columns.at("let_go")[1] > 0);
  CHECK(*std::ranges::max_element(columns.at("lag")) > 0);  // a sheet is in the way
}

}  // namespace

}  // namespace test_measurements
