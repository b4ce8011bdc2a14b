// A hung sheet of a material, with the settings that materials bring, is as long and swings as fast as it should,
// whatever its cells and how they are cut.
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "pliant/forces/gravity.h"
#include "pliant/materials/material_groups.h"
#include "pliant/mesh/shapes.h"

namespace test_hung_material {

using namespace pliant;

namespace {

constexpr Real gravity = 9.81;
/// Of a chain or a sheet of length one that hangs from its upper end, in √g: half the first zero of the Bessel function
/// J₀, whose J₀(2ω √(s/g)), s from the lower end, is the mode.
constexpr Real first_frequency = 1.2024128;

/// Of a meter that hangs [m]: what lies s above the end carries ρ g s. Up to a stretch of 1 + 2 · 0.005 threads carry
/// k₀ b + (k₁ − k₀) b²/0.02, shear 2 G b.
Real elongation(const SheetMaterial& sheet) {
  const Real weight = gravity * sheet.area_density;  // of a meter, a meter wide [N/m]
  const Real threads = weight / 1e-3 - 2 * sheet.shear;
  const Real soft = 0.005 * threads + 2 * sheet.shear;
  const Real taut = std::min(sheet.stretch_warp, 5 * threads + 2 * sheet.shear);
  const Real rise = (taut - soft) / 0.01;
  REQUIRE(weight < soft * 0.01 + rise * 0.01 * 0.01 / 2);  // the rise alone
  constexpr int parts = 1000;
  Real sum = 0;
  for (int i = 0; i < parts; ++i) {
    const Real load = weight * (i + 0.5) / parts;
    sum += (std::sqrt(soft * soft + 2 * rise * load) - soft) / rise / parts;
  }
  return sum;
}

/// A strip of a meter, hung by its upper edge.
struct Strip {
  Simulation simulation;
  Index columns;

  Strip(const Material& material, Index cells, Diagonals diagonals, Index iterations,
        const MaterialPlacement& placement = {})
      : simulation(settings(iterations)), columns(cells / 4 + 1) {
    const Mesh mesh = grid({.columns = columns, .rows = cells + 1, .size = {0.25, 1}, .diagonals = diagonals});
    const BodyId body = simulation.add_body(mesh, mass_of(material));
    add_material(simulation, body, material, placement);
    std::vector<Index> top;
    for (Index i = 0; i < mesh.vertex_count(); ++i) {
      if (mesh.vertices(i, 2) > 1 - 1e-9) top.push_back(i);
    }
    simulation.add(body, Position{.on = top});
    simulation.add(Gravity{});
  }
  static SolverSettings settings(Index iterations) {
    SolverSettings settings = settings_for_materials();
    settings.iterations = iterations;
    settings.threads = 1;
    return settings;
  }
  /// Of the lower edge.
  Vec3 end() const { return simulation.state().positions.topRows(columns).colwise().mean().transpose(); }
  Real damped_length() {
    SolverSettings settings = simulation.settings();
    settings.damping = 5;
    simulation.set_settings(settings);
    for (int i = 0; i < 120; ++i) simulation.step();
    settings.damping = 0;
    simulation.set_settings(settings);
    return 1 - end()[2];
  }
  /// Of the first mode, begun with a speed of 1 cm/s: from zero to zero after it has gone to both sides.
  Real period() {
    const Positions x = simulation.state().positions;
    Positions v = Positions::Zero(x.rows(), 3);
    for (Index i = 0; i < v.rows(); ++i) {
      const Real s = std::max<Real>(x(i, 2) - end()[2], 0);
      v(i, 1) = 0.01 * std::cyl_bessel_j(Real{0}, 2 * first_frequency * std::sqrt(s));
    }
    simulation.set_state(x, v);
    Real before = 0, start = simulation.state().time, zero = 0;
    for (int zeros = 0; zeros < 2;) {
      simulation.step();
      const Real now = end()[1];
      REQUIRE(simulation.state().time - start < 10);
      if (before != 0 && (now > 0) != (before > 0)) {
        ++zeros;
        zero = simulation.state().time - simulation.settings().time_step * now / (now - before);
      }
      before = now;
    }
    return zero - start;
  }
};

}  // namespace

TEST_CASE("a hung sheet of wool is as long as its threads say, and its first period is that of a hanging sheet") {
  const Material& wool = builtin_material("wool");
  const Real longer = elongation(std::get<SheetMaterial>(wool.of));
  const Real period = 2 * std::numbers::pi / (first_frequency * std::sqrt(gravity));
  for (const Diagonals diagonals : {Diagonals::forward, Diagonals::alternating, Diagonals::crossed}) {
    for (const Index cells : {8, 16, 24, 32}) {
      CAPTURE(cells);
      CAPTURE(static_cast<int>(diagonals));
      // With the usual 20 iterations motion lags a little behind, the more so the finer the mesh.
      for (const auto& trial : {std::pair<Index, Real>{20, 0.03}, std::pair<Index, Real>{40, 0.01}}) {
        CAPTURE(trial.first);
        Strip strip(wool, cells, diagonals, trial.first);
        CHECK(strip.damped_length() - 1 == doctest::Approx(longer).epsilon(0.05).scale(0));
        CHECK(strip.period() == doctest::Approx(period).epsilon(trial.second));
      }
    }
  }
}

TEST_CASE("a hung sheet without slack is as long as its modulus says, and swings as it should") {
  const Real period = 2 * std::numbers::pi / (first_frequency * std::sqrt(gravity));
  for (const Diagonals diagonals : {Diagonals::forward, Diagonals::crossed}) {
    Strip strip(builtin_material("wool"), 16, diagonals, 40, {.slack = 0});
    // The threads have the modulus with which a meter is longer by a thousandth under its weight at the top.
    CHECK(strip.damped_length() - 1 == doctest::Approx(0.0005).epsilon(0.1).scale(0));
    CHECK(strip.period() == doctest::Approx(period).epsilon(0.01));
  }
}

TEST_CASE("cotton that falls and is caught by two corners does not stretch like rubber") {
  Simulation simulation(Strip::settings(20));
  const Mesh mesh = grid({.columns = 31, .rows = 31, .size = {1, 1}, .plane = Plane::xy});
  const BodyId body = simulation.add_body(mesh, mass_of(builtin_material("cotton")));
  add_material(simulation, body, builtin_material("cotton"));
  simulation.add(body, Position{.on = std::vector<Index>{0, 30}});
  simulation.add(Gravity{});
  Real longest = 0;
  for (int i = 0; i < 90; ++i) {
    simulation.step();
    for (Index row_of = 0; row_of < 31; ++row_of) {
      for (Index v = 31 * row_of; v < 31 * row_of + 30; ++v) {  // along the weft
        const Real length = (row(simulation.state().positions, v + 1) - row(simulation.state().positions, v)).norm();
        longest = std::max(longest, length * 30);
      }
    }
  }
  CHECK(longest < 1.035);
}

}  // namespace test_hung_material
