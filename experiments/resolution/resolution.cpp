#include "resolution/resolution.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "resolution/sheet.h"

namespace pliant_experiments {
namespace {

using namespace pliant;
using namespace pliant_report;

// Each number of cells is twice the one before.
constexpr std::array<int, 4> sizes = {11, 21, 41, 81};
constexpr std::array<std::string_view, 3> diagonals = {"forward", "alternating", "crossed"};
constexpr double pulling_tension = 2.5;  // [N/m], a tenth of the stiffness
constexpr double angle_step = 7.5;
constexpr int pulled_size = 41;

const Material spring_material{"springs", "springs of one constant k", 5};
const Material strain{"strain", "triangle strain", 6};
const Material fibres{"fibres", "fibres of one EA", 7};

/// The drops of one material: of each tessellation a row, of each size an entry.
struct Hanging {
  Material material;
  std::array<std::array<Drop, sizes.size()>, diagonals.size()> drops{};
};

Hanging hang(const ExperimentContext& context, const Material& material) {
  Hanging hanging{material};
  for (std::size_t cut = 0; cut < diagonals.size(); ++cut) {
    for (std::size_t size = 0; size < sizes.size(); ++size) {
      context.say(fmt::format("{}, {} diagonals, {} vertices a side", material.name, diagonals[cut], sizes[size]));
      hanging.drops[cut][size] = drop(hung(context, material, {sizes[size], std::string(diagonals[cut])}));
    }
  }
  return hanging;
}

struct Extent {
  double least = 0;
  double most = 0;
  double spread() const { return 2 * (most - least) / (most + least); }
};

Extent extent(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return {*least, *most};
}

Extent sags(const Hanging& hanging) {
  std::vector<double> all;
  for (const auto& row : hanging.drops) {
    for (const Drop& each : row) all.push_back(each.down);
  }
  return extent(all);
}

Extent finest_sags(const Hanging& hanging) {
  std::vector<double> all;
  for (const auto& row : hanging.drops) all.push_back(row.back().down);
  return extent(all);
}

/// The sag of a continuum whose stress is k (stretch − 1): its weight times its height over 2 k times its width.
double continuum_sag(const ExperimentContext& context) {
  const Scene scene = context.scene("resolution/strain");
  const Simulation& simulation = scene.simulation;
  const State& state = simulation.state();
  Positions forces = Positions::Zero(state.vertex_count(), 3);
  for (const auto& [id, force] : simulation.forces()) {
    force->add_to(forces, state.view(), simulation.settings().time_step);
  }
  const Vec3 size = (state.positions.colwise().maxCoeff() - state.positions.colwise().minCoeff()).transpose();
  const double stiffness = simulation.stiffness(simulation.find_group("cloth").value()).value();
  return -forces.col(2).sum() * size.z() / (2 * stiffness * size.x());
}

// ---- what is pulled

/// Elongations of one sheet over the directions in which it is pulled.
struct Pulling {
  Material material;
  Tessellation tessellation;
  std::vector<double> degrees{};
  std::vector<double> elongations{};
};

Pulling pull(const ExperimentContext& context, const Material& material, const Tessellation& tessellation) {
  context.say(fmt::format("{}, {} diagonals, pulled in all directions", material.name, tessellation.diagonals));
  Pulling pulling{material, tessellation};
  for (double degrees = 0; degrees <= 180; degrees += angle_step) {
    pulling.degrees.push_back(degrees);
    pulling.elongations.push_back(
        elongation(pulled(context, material, tessellation, degrees, pulling_tension), degrees));
  }
  return pulling;
}

// ---- plots, tables and pictures

Plot sag_plot(const std::vector<Hanging>& all) {
  Plot plot{.title = "Sag of the lower edge over the resolution",
            .caption =
                "Lines: diagonals that all lean one way; dashed: crossed ones, which are alternating ones turned by 45 "
                "degrees. Triangle strain: one level line for both. Springs of one constant settle at two levels. "
                "Fibres of one cross-section go to zero.",
            .x = {.label = "vertices a side", .is_logarithmic = true},
            .y = {.label = "sag [cm]", .min = 0.},
            .series = {}};
  for (const Hanging& hanging : all) {
    for (const std::size_t cut : {std::size_t{0}, std::size_t{2}}) {
      Series series{.name = fmt::format("{}, {}", hanging.material.name, diagonals[cut]),
                    .mark = Mark::line_and_points,
                    .is_dashed = cut != 0,
                    .color = hanging.material.color};
      for (std::size_t i = 0; i < sizes.size(); ++i) {
        series.x.push_back(sizes[i]);
        series.y.push_back(100 * hanging.drops[cut][i].down);
      }
      plot.series.push_back(std::move(series));
    }
  }
  return plot;
}

Plot pull_plot(const std::vector<Pulling>& all) {
  Plot plot{.title = "Elongation over the direction of the pull",
            .caption = fmt::format("{0} × {0} vertices under the same tension of {1} N/m everywhere. Triangle strain "
                                   "gives way alike in all directions. Springs whose diagonals lean one way resist "
                                   "along them (45 degrees) and give way across them (135 degrees).",
                                   pulled_size, pulling_tension),
            .x = {.label = "direction, from the rows of the mesh [degrees]", .min = 0., .max = 180.},
            .y = {.label = "elongation [%]", .min = 0.},
            .series = {}};
  for (const Pulling& pulling : all) {
    Series series{.name = fmt::format("{}, {}", pulling.material.name, pulling.tessellation.diagonals),
                  .x = pulling.degrees,
                  .is_dashed = pulling.tessellation.diagonals != diagonals.front(),
                  .color = pulling.material.color};
    for (const double value : pulling.elongations) series.y.push_back(100 * value);
    plot.series.push_back(std::move(series));
  }
  return plot;
}

Table sag_table(const std::vector<Hanging>& all) {
  Table table{"Sag of the lower edge, and behind it how far it has gone aside [cm]", {"cloth", "diagonals"}};
  for (const int size : sizes) table.columns.push_back(fmt::format("{0} × {0}", size));
  for (const Hanging& hanging : all) {
    for (std::size_t cut = 0; cut < diagonals.size(); ++cut) {
      std::vector<std::string> row = {hanging.material.name, std::string(diagonals[cut])};
      for (const Drop& each : hanging.drops[cut]) {
        row.push_back(fmt::format("{:.3f}, {:.2f}", 100 * each.down, std::abs(100 * each.aside)));
      }
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

void add_pictures(const ExperimentContext& context, Chapter& chapter) {
  const auto picture = [&context](const Material& material, const Tessellation& tessellation) {
    return context.picture(hung(context, material, tessellation));
  };
  context.show(
      chapter,
      {picture(spring_material, {21, "forward"}), picture(spring_material, {21, "backward"}),
       picture(strain, {21, "forward"}), picture(strain, {21, "backward"})},
      2,
      "Above, springs of one constant: with diagonals from the lower left to the upper right the cloth goes one "
      "way, with the others the other way. Below, triangle strain on the same two meshes.");
  context.show(chapter, {picture(fibres, {11, "forward"}), picture(fibres, {41, "forward"})}, 2,
               "Fibres of one cross-section on 11 × 11 and on 41 × 41 vertices.");
}

// ---- claims

Claim strain_is_one_cloth(const Hanging& hanging, const std::vector<Pulling>& pullings) {
  constexpr double most_spread = 1e-3;
  const Extent sag = sags(hanging);
  std::vector<double> elongations;
  for (const Pulling& pulling : pullings) {
    if (pulling.material.scene != strain.scene) continue;
    elongations.insert(elongations.end(), pulling.elongations.begin(), pulling.elongations.end());
  }
  const Extent pulled_strain = extent(elongations);
  return {
      .text = "Constraints on strain behave the same at any resolution and in any orientation of the mesh",
      .by = "Bouaziz et al. 2014",
      .verdict = sag.spread() <= most_spread && pulled_strain.spread() <= most_spread ? Verdict::holds : Verdict::fails,
      .evidence = fmt::format("Sags of {} meshes from {:.3f} to {:.3f} cm: a spread of {:.3f} %; elongations in all "
                              "directions from {:.4f} to {:.4f} %: {:.1e} %.",
                              sizes.size() * diagonals.size(), 100 * sag.least, 100 * sag.most, 100 * sag.spread(),
                              100 * pulled_strain.least, 100 * pulled_strain.most, 100 * pulled_strain.spread())};
}

Claim strain_is_continuum(const Hanging& hanging, double exact) {
  const Extent sag = sags(hanging);
  const double error = std::max(std::abs(sag.least - exact), std::abs(sag.most - exact)) / exact;
  return {.text = "It is the behavior of the continuum that they stand for",
          .by = "Bouaziz et al. 2014",
          .verdict = error <= 1e-3 ? Verdict::holds : Verdict::fails,
          .evidence = fmt::format("In closed form the sag is {:.3f} cm; no mesh is off by more than {:.3f} %.",
                                  100 * exact, 100 * error)};
}

Claim springs_depend_on_mesh(const Hanging& hanging) {
  constexpr double least_spread = .05;
  const Extent sag = finest_sags(hanging);
  return {.text = "Springs behave otherwise in each mesh",
          .by = "Bouaziz et al. 2014",
          .verdict = sag.spread() >= least_spread ? Verdict::holds : Verdict::fails,
          .evidence = fmt::format("At {0} × {0} vertices the sag is from {1:.2f} to {2:.2f} cm, a spread of {3:.0f} %; "
                                  "diagonals that lean one way draw the lower edge {4:.2f} cm aside.",
                                  sizes.back(), 100 * sag.least, 100 * sag.most, 100 * sag.spread(),
                                  std::abs(100 * hanging.drops.front().back().aside))};
}

Claim springs_converge(const Hanging& hanging) {
  Claim claim{"Springs of one constant converge under refinement of one kind of mesh", "", Verdict::holds};
  for (std::size_t cut = 0; cut < diagonals.size(); ++cut) {
    const auto& drops = hanging.drops[cut];
    std::vector<std::string> changes;
    for (std::size_t i = 1; i < sizes.size(); ++i) {
      const double change = drops[i].down - drops[i - 1].down;
      changes.push_back(fmt::format("{:.2f}", 100 * change));
      if (i == 1) continue;
      if (std::abs(change) > .75 * std::abs(drops[i - 1].down - drops[i - 2].down)) claim.verdict = Verdict::fails;
    }
    claim.evidence +=
        fmt::format("{} diagonals: from one mesh to the next {} cm. ", diagonals[cut], fmt::join(changes, ", "));
  }
  return claim;
}

Claim springs_depend_on_direction(const std::vector<Pulling>& pullings) {
  Claim claim{"Springs whose diagonals all lean one way are several times as stiff along them as across", "",
              Verdict::reported};
  for (const Pulling& pulling : pullings) {
    if (pulling.material.scene != spring_material.scene) continue;
    const Extent found = extent(pulling.elongations);
    claim.evidence +=
        fmt::format("{} diagonals: elongations from {:.2f} to {:.2f} %, a factor of {:.2f}. ",
                    pulling.tessellation.diagonals, 100 * found.least, 100 * found.most, found.most / found.least);
    if (pulling.tessellation.diagonals == diagonals.front()) {
      claim.verdict = found.most > 2 * found.least ? Verdict::holds : Verdict::fails;
    }
  }
  return claim;
}

Claim fibres_halve(const Hanging& hanging) {
  Claim claim{"Cloth of fibres of one cross-section halves its sag with each refinement", "", Verdict::holds};
  for (std::size_t cut = 0; cut < diagonals.size(); ++cut) {
    const auto& drops = hanging.drops[cut];
    std::vector<std::string> ratios;
    for (std::size_t i = 1; i < sizes.size(); ++i) {
      ratios.push_back(fmt::format("{:.2f}", drops[i - 1].down / drops[i].down));
    }
    claim.evidence += fmt::format("{} diagonals: divided by {}. ", diagonals[cut], fmt::join(ratios, ", "));
    if (std::abs(drops[sizes.size() - 2].down / drops.back().down - 2) > .1) claim.verdict = Verdict::fails;
  }
  return claim;
}

}  // namespace

Chapter run_resolution(const ExperimentContext& context) {
  const std::vector<Hanging> hanging = {hang(context, spring_material), hang(context, strain), hang(context, fibres)};
  const std::vector<Pulling> pullings = {pull(context, spring_material, {pulled_size, "forward"}),
                                         pull(context, spring_material, {pulled_size, "alternating"}),
                                         pull(context, strain, {pulled_size, "forward"}),
                                         pull(context, strain, {pulled_size, "crossed"})};

  Chapter chapter;
  chapter.question =
      "Is it the same cloth when its mesh is another one? A sheet of 1 m and 1 kg hangs by its upper edge, at four "
      "resolutions and with its cells cut in three ways, and a sheet without weight is pulled by one tension in every "
      "direction. Both stay flat, and are solved until they rest. Compared are springs of one constant k, fibres of "
      "one cross-section EA, and triangle strain.";
  chapter.claims = {strain_is_one_cloth(hanging[1], pullings), strain_is_continuum(hanging[1], continuum_sag(context)),
                    springs_depend_on_mesh(hanging[0]),        springs_converge(hanging[0]),
                    springs_depend_on_direction(pullings),     fibres_halve(hanging[2])};
  chapter.blocks.emplace_back(sag_plot(hanging));
  chapter.blocks.emplace_back(sag_table(hanging));
  chapter.blocks.emplace_back(pull_plot(pullings));
  add_pictures(context, chapter);
  return chapter;
}

}  // namespace pliant_experiments
