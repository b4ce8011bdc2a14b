#include "hand/hand.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "pliant/forces/test_force.h"
#include "support/bend.h"
#include "support/claims.h"

namespace pliant_experiments {
namespace {

using pliant::Index;
using pliant::Vec3;
using pliant_report::Chapter;
using pliant_report::Mark;
using pliant_report::Plot;

constexpr std::array<double, 5> forces = {1, 10, 100, 1000, 10000};  // [N] on each fingertip
constexpr double bending = 0.5;                                      // [N m]
constexpr std::int64_t pull_frames = 60;
constexpr std::int64_t home_frames = 360;
constexpr double recognizable = 0.02;  // of the hand's length

struct Return {
  bool is_finite = true;
  double pulled = 0;  // mean distance of the vertices from their rest places, over the length, while the force draws
  double left = 0;    // and after it
  pliant_render::Image during{}, after{};
};

/// The hand of the built-in scene, upright and weightless, of skin alone, with a fixed wrist.
pliant::Scene make_hand(const ExperimentContext& context) {
  return context.builtin_scene(
      "hand", {"settings.iterations=20", "settings.integrator=implicit_euler", "settings.substeps=1",
               "settings.acceleration=none", "gravity=null", "forces=[]", "moves=[]", "bodies[hand].transform={}",
               R"(bodies[hand].constraints=[
                 {"type": "position", "name": "wrist",
                  "on": {"half_space": {"point": [0, 0, 0.0096], "normal": [0, 0, -1]}}},
                 {"type": "edge_spring", "name": "skin", "stiffness": 2000}])",
               "view.size=[480,480]", "view.ground=false",
               R"(view.camera={"position": [0.02, -0.36, 0.14], "target": [0.02, 0, 0.085]})"});
}

/// The vertices that are farthest up in each fifth of the hand's breadth: the tips of four fingers and the thumb.
std::vector<Index> fingertips(const pliant::Positions& rest) {
  const double low = rest.col(0).minCoeff();
  const double breadth = rest.col(0).maxCoeff() - low;
  std::vector<Index> tips(5, -1);
  for (Index i = 0; i < static_cast<Index>(rest.rows()); ++i) {
    const auto fifth = std::min<std::size_t>(4, static_cast<std::size_t>(5 * (rest(i, 0) - low) / breadth));
    if (tips[fifth] < 0 || rest(i, 2) > rest(tips[fifth], 2)) tips[fifth] = i;
  }
  return tips;
}

double distance(const pliant::Simulation& simulation) {
  const pliant::Positions& rest = simulation.bodies()[0].mesh.vertices;
  const double length = rest.col(2).maxCoeff() - rest.col(2).minCoeff();
  return (simulation.state().positions - rest).rowwise().norm().mean() / length;
}

Return pull(const ExperimentContext& context, double force, Bend bend) {
  context.say(fmt::format("{} N, {}", force, name_of(bend)));
  pliant::Scene scene = make_hand(context);
  pliant::Simulation& simulation = scene.simulation;
  add_bending(scene, bend, bending);
  context.disturb(scene);
  // Each tip is drawn another way: forwards, backwards, across and down.
  const std::array<Vec3, 5> ways = {Vec3(-1, 1, 0), Vec3(0, -1, -1), Vec3(1, 1, 1), Vec3(0, 1, -2), Vec3(1, -1, 0)};
  const std::vector<Index> tips = fingertips(simulation.state().positions);
  for (std::size_t i = 0; i < tips.size(); ++i) {
    const Vec3 pull_force = force * ways[i].normalized();
    simulation.add(pliant::TestForce{.vertices = {tips[i]}, .force = pull_force, .frames = {0, pull_frames}});
  }
  Return result;
  result.is_finite = context.try_steps(scene, pull_frames);
  result.pulled = distance(simulation);
  result.during = context.picture(scene);
  result.is_finite = result.is_finite && context.try_steps(scene, home_frames);
  result.left = distance(simulation);
  result.after = context.picture(scene);
  return result;
}

using Returns = std::map<Bend, std::vector<Return>>;  // by force

/// The strongest of the forces up to which the hand is recognizable afterwards [N]; 0: none.
double most_force(const std::vector<Return>& returns) {
  double force = 0;
  for (std::size_t i = 0; i < forces.size() && returns[i].left < recognizable; ++i) force = forces[i];
  return force;
}

void judge(Chapter& chapter, const Returns& all) {
  std::ptrdiff_t finite = 0;
  for (const auto& [bend, returns] : all) finite += std::ranges::count_if(returns, &Return::is_finite);
  const auto runs = static_cast<std::ptrdiff_t>(bends.size() * forces.size());
  chapter.claims.push_back(
      claim("Strong forces do not make it unstable", "thesis, Sec. 6.1", finite == runs,
            fmt::format("{} of {} runs stay finite, with up to {:.0f} N on each tip, {:.0f} times the hand's weight",
                        finite, runs, forces.back(), forces.back() / (0.5 * 9.81))));
  const double none = most_force(all.at(Bend::none));
  const double absolute = most_force(all.at(Bend::absolute));
  const double with_sign = most_force(all.at(Bend::signed_));
  chapter.claims.push_back(claim(
      "With bending the hand is still recognizable after external forces, unless they are extreme", "thesis, Sec. 6.3",
      absolute >= 10 && with_sign >= 10 && absolute > none,
      fmt::format(
          "within {:.0f} % of its length up to {:.0f} N with absolute bending, {:.0f} N with signed, {:.0f} N without",
          100 * recognizable, absolute, with_sign, none)));
}

void draw(const ExperimentContext& context, Chapter& chapter, Returns& all) {
  std::vector<pliant_render::Image> pictures;
  for (const Bend bend : bends) {
    pictures.push_back(std::move(all[bend][1].during));
    for (const std::size_t i : {1U, 2U, 4U}) pictures.push_back(std::move(all[bend][i].after));
  }
  context.show(chapter, pictures, 4,
               "Under 10 N on each tip, and after 10, 100 and 10,000 N: above without bending, in the middle with "
               "absolute, below with signed bending.");
}

}  // namespace

Chapter run_hand(const ExperimentContext& context) {
  Chapter chapter;
  chapter.question = fmt::format(
      "A hollow hand of 348 vertices and half a kilogram, skin of 2000 N/m, is held at the wrist. Each of its five "
      "tips is drawn another way for 60 frames by 1 to 10,000 N, then left alone for 360. Is it a hand afterwards, "
      "without bending and with {} N m? Measured is the mean distance of its vertices from where they were, over its "
      "length.",
      bending);
  Returns all;
  Plot plot{.title = "What is left of a hand",
            .caption = "Mean distance of the vertices from their rest places after the force, over the hand's length.",
            .x = {.label = "force on each fingertip [N]", .is_logarithmic = true},
            .y = {.label = "distance / length", .is_logarithmic = true},
            .series = {},
            .guides = {{recognizable, "recognizable below", false}}};
  pliant_report::Table table{"Mean distance over the hand's length, at the end of the force and 360 frames later.",
                             {"force [N]", "bending", "at the end of the force", "later"},
                             {}};
  for (const Bend bend : bends) {
    const std::string name = name_of(bend);
    pliant_report::Series series{.name = name, .mark = Mark::line_and_points};
    for (const double force : forces) {
      Return result = pull(context, force, bend);
      series.x.push_back(force);
      series.y.push_back(result.left);
      table.rows.push_back({fmt::format("{:.0f}", force), name, fmt::format("{:.4f}", result.pulled),
                            fmt::format("{:.5f}", result.left)});
      all[bend].push_back(std::move(result));
    }
    plot.series.push_back(std::move(series));
  }
  judge(chapter, all);
  draw(context, chapter, all);
  chapter.blocks.emplace_back(std::move(plot));
  chapter.blocks.emplace_back(std::move(table));
  return chapter;
}

}  // namespace pliant_experiments
