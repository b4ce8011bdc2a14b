#include "contact/sheets_on_sheets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "contact/sheet_on_plane.h"
#include "support/claims.h"

namespace pliant_experiments {
namespace {

using pliant::Index;
using pliant::Vec3;
using pliant_report::Chapter;
using pliant_report::Table;

constexpr Index layer_count = 5;
constexpr double friction_of_sheets = 0.3;
constexpr double standard_gravity = 9.81;

pliant::BodyId add_sheet(pliant::Simulation& simulation, const pliant::Mesh& mesh) {
  const pliant::BodyId body = simulation.add_body(mesh, pliant::Mass::area_density(0.2));
  simulation.add(body, pliant::TriangleStrain{.stiffness = 1e3});
  simulation.add(body, pliant::Bending{.stiffness = 1e-5});
  return body;
}

double usual_distance_of(const pliant::Mesh& mesh) {
  pliant::Simulation probe;
  return probe.contact_distance(probe.add_body(mesh, pliant::Mass::per_vertex(1)));
}

pliant::Mesh flat_sheet(Index columns, Index rows, double width) {
  return pliant::grid({.columns = columns,
                       .rows = rows,
                       .size = {width, width * static_cast<double>(rows - 1) / static_cast<double>(columns - 1)},
                       .plane = pliant::Plane::xy,
                       .diagonals = pliant::Diagonals::alternating});
}

// ---- loads

/// Layers on each other and on a floor.
pliant::Scene layers_at_rest(double shift) {
  pliant::SolverSettings settings;
  settings.iterations = 20;
  settings.threads = 1;
  settings.damping = 5;
  pliant::Scene scene;
  scene.name = "contact";
  scene.simulation = pliant::Simulation(settings);
  const pliant::Mesh sheet = flat_sheet(8, 8, 0.5);
  const double distance = usual_distance_of(sheet);
  for (Index i = 0; i < layer_count; ++i) {
    pliant::Mesh mesh = sheet;
    const double way = shift * 0.5 / 7 * static_cast<double>(i);
    mesh.vertices.rowwise() += Vec3(way, 0.6 * way, 1.0005 * distance * static_cast<double>(i + 1)).transpose();
    add_sheet(scene.simulation, mesh);
  }
  scene.simulation.add(pliant::Gravity{});
  scene.simulation.add(pliant::PlaneCollider{});
  scene.simulation.set_contact({.distance = distance, .friction = friction_of_sheets, .surfaces = true});
  return scene;
}

/// What lies on each layer and itself weighs, as contact carries it, over what it should be: mean of the last steps.
/// The layers are counted from the top.
std::vector<double> loads_of(const ExperimentContext& context, double shift) {
  constexpr int steps = 120, counted = 40;
  pliant::Scene scene = layers_at_rest(shift);
  std::vector<double> loads(layer_count);
  for (int step = 0; step < steps; ++step) {
    context.step(scene);
    if (step < steps - counted) continue;
    const std::vector<pliant::VertexTouch> touches = scene.simulation.touches();
    double carried = 0, weight = 0;
    for (Index i = 0; i < layer_count; ++i) {
      const pliant::Body& body = scene.simulation.bodies()[static_cast<std::size_t>(layer_count - 1 - i)];
      for (Index v = body.first_vertex; v < body.first_vertex + body.mesh.vertex_count(); ++v) {
        carried += touches[static_cast<std::size_t>(v)].force.z();
        weight += standard_gravity * scene.simulation.state().masses[static_cast<std::size_t>(v)];
      }
      loads[static_cast<std::size_t>(i)] += carried / weight / counted;
    }
  }
  return loads;
}

// ---- friction

/// A sheet on a pinned one. Gravity is tilted in place of both.
pliant::Scene sheet_on_sheet(const pliant::SolverSettings& settings, double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  pliant::Mesh low = flat_sheet(48, 18, 2.2);
  pliant::Mesh top = flat_sheet(12, 12, 0.4);
  const double distance = std::min(usual_distance_of(low), usual_distance_of(top));
  low.vertices.rowwise() += Vec3(-0.2, -0.2, 0).transpose();
  const Eigen::AngleAxis<double> turn(0.3, Vec3::UnitZ());  // no vertex lies above another
  for (Index i = 0; i < top.vertex_count(); ++i) {
    const Vec3 middle(0.2, 0.2, 0);
    const Vec3 x = middle + turn * (pliant::row(top.vertices, i) - middle) + Vec3(0, 0, 1.0005 * distance);
    top.vertices.row(i) = x.transpose();
  }
  pliant::Scene scene;
  scene.name = "contact";
  scene.simulation = pliant::Simulation(settings);
  scene.simulation.add(add_sheet(scene.simulation, low), pliant::Position{});
  add_sheet(scene.simulation, top);
  scene.simulation.add(
      pliant::Gravity{.acceleration = {standard_gravity * std::sin(angle), 0, -standard_gravity * std::cos(angle)}});
  scene.simulation.set_contact({.distance = distance, .friction = friction_of_sheets, .surfaces = true});
  return scene;
}

struct SlideOfSheet {
  double sheet = 0, point = 0;  // ways in a second [m]
};

SlideOfSheet slide_on_sheet(const ExperimentContext& context, const ContactMethod& method, double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  pliant::Scene scene = sheet_on_sheet(contact_settings(method), degrees);
  SlidingPoint point(method, {.pull = standard_gravity * std::sin(angle),
                              .friction = friction_of_sheets * standard_gravity * std::cos(angle)});
  const pliant::Body& top = scene.simulation.bodies()[1];
  const Index first = top.first_vertex, count = top.mesh.vertex_count();
  const auto place = [&] { return scene.simulation.state().positions.middleRows(first, count).col(0).mean(); };
  const double begin = place();
  for (int i = 0; i < 60; ++i) {
    context.step(scene);
    point.step();
  }
  return {place() - begin, point.way()};
}

}  // namespace

void measure_layer_loads(const ExperimentContext& context, Chapter& chapter) {
  Table table{
      "Five sheets on each other and on a floor: what contact carries at each of them, counted from the top, "
      "over the weight of it and of all above, the mean of 40 steps at rest. 20 iterations.",
      {"layers", "1", "2", "3", "4", "5"},
      {}};
  double worst = 0;
  for (const double shift : {0.0, 0.37}) {
    context.say("loads through layers");
    const std::vector<double> loads = loads_of(context, shift);
    table.rows.push_back({shift == 0 ? "vertex over vertex" : "shifted by 0.37 of an edge each"});
    for (const double each : loads) {
      table.rows.back().push_back(fmt::format("{:.5f}", each));
      worst = std::max(worst, std::abs(each - 1));
    }
  }
  chapter.claims.push_back(claim("Each layer of a stack carries what lies on it, within 2 %", "", worst <= 0.02,
                                 fmt::format("{:.1e} off at most, five layers in two places", worst)));
  chapter.blocks.emplace_back(std::move(table));
}

void measure_sheet_on_sheet(const ExperimentContext& context, Chapter& chapter) {
  Table table{
      "Way of a sheet of 12 x 12 vertices down a pinned one in 1 s, friction 0.3 (limit 16.7°), and of a point "
      "that slides in the same steps.",
      {"integrator", "iterations", "16° [mm]", "17° [m]", "point [m]", "error", "30° [m]", "point [m]", "error"},
      {}};
  for (ContactMethod method : contact_methods()) {
    for (const Index iterations : {10, 20}) {
      context.say(fmt::format("sheet on sheet, {}, {} iterations", method.name, iterations));
      method.iterations = iterations;
      const double drift = slide_on_sheet(context, method, 16).sheet;
      const SlideOfSheet gentle = slide_on_sheet(context, method, 17);
      const SlideOfSheet steep = slide_on_sheet(context, method, 30);
      const auto error = [](const SlideOfSheet& slide) { return std::abs(slide.sheet / slide.point - 1); };
      table.rows.push_back({method.name, std::to_string(iterations), fmt::format("{:.2g}", 1e3 * drift),
                            fmt::format("{:.5f}", gentle.sheet), fmt::format("{:.5f}", gentle.point),
                            fmt::format("{:.1e}", error(gentle)), fmt::format("{:.5f}", steep.sheet),
                            fmt::format("{:.5f}", steep.point), fmt::format("{:.1e}", error(steep))});
      chapter.claims.push_back(
          claim(fmt::format("A sheet on a sheet sticks at 16°, to a millimeter, and slides at 17° and 30° as far as "
                            "Coulomb's law says, within 2 %: {}, {} iterations",
                            method.name, iterations),
                "", std::abs(drift) < 1e-3 && error(gentle) <= 0.02 && error(steep) <= 0.02,
                fmt::format("{:.2g} mm at 16°, off by {:.1e} at 17° and {:.1e} at 30°", 1e3 * drift, error(gentle),
                            error(steep))));
    }
  }
  chapter.blocks.emplace_back(std::move(table));
}

}  // namespace pliant_experiments
