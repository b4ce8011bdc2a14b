#include "tests/pairs/pair_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

#include "pliant/collision/crossings.h"
#include "pliant/collision/pairs/joined_vertices.h"
#include "pliant/constraints/attachment.h"
#include "pliant/core/error.h"
#include "pliant/simulation/held.h"
#include "tests/pairs/body_scenes.h"
#include "tests/pairs/bounce_scenes.h"
#include "tests/pairs/cloth_scenes.h"
#include "tests/pairs/figure_scenes.h"
#include "tests/pairs/masonry_scenes.h"

namespace pliant_tests {

using namespace pliant;

Index PairScene::frames() const {
  return static_cast<Index>(std::lround(duration / simulation.settings().time_step));
}

StepReport PairScene::step() {
  if (move) move(simulation);
  return take ? take(simulation) : simulation.step();
}

std::span<const PairSceneEntry> pair_scenes() {
  static constexpr std::array entries{
      PairSceneEntry{"drape", "a sheet on a sphere above a floor, 5 s", drape},
      PairSceneEntry{"rotating_sphere", "a sheet on a sphere that begins to turn, 4 s", rotating_sphere},
      PairSceneEntry{"twist", "a strip whose ends turn four times against each other, 8 s", twist},
      PairSceneEntry{"fold", "an upright strip folds onto a floor, 5 s", fold},
      PairSceneEntry{"stack", "five sheets fall on a sphere, 4 s", stack},
      PairSceneEntry{"block", "8.8 kg of rubber on a pinned sheet of 72 g above a floor, 5 s", block},
      PairSceneEntry{"fall", "a sheet hits a sphere with 5.5 m/s, 1 s", fall},
      PairSceneEntry{"two_sheets", "a sheet falls on a pinned one, 3 s", two_sheets},
      PairSceneEntry{"slope2_gentle", "a sheet on a pinned one, at 16 degrees, 1 s", slope2_gentle},
      PairSceneEntry{"slope2_near_limit", "a sheet on a pinned one, at 17 degrees, 1 s", slope2_near_limit},
      PairSceneEntry{"slope2_steep", "a sheet on a pinned one, at 30 degrees, 1 s", slope2_steep},
      PairSceneEntry{"layers_free", "a sheet slides on a free one on a plane, 2 s", two_layers_free},
      PairSceneEntry{"rope", "a coil of rope falls on a pinned sheet, 3 s", rope},
      PairSceneEntry{"coil", "an upright rope falls on a floor and itself, 3 s", coil},
      PairSceneEntry{"pile", "soft boxes and balls fall into each other on a floor, 5 s", pile},
      PairSceneEntry{"collision", "two soft boxes fly at each other, 1 s", collision_of_two},
      PairSceneEntry{"bounce_block", "a block falls on one whose bottom is pinned, 1 s", bounce_block},
      PairSceneEntry{"bounce_sheet", "a sheet falls on one whose border is pinned, 1 s", bounce_sheet},
      PairSceneEntry{"bounce_ball", "a ball falls on a sheet whose border is pinned, 1 s", bounce_ball},
      PairSceneEntry{"tower", "20 boxes on each other, 5 s; with --friction 0.6 they stand", tower_of_20},
      PairSceneEntry{"arch", "11 wedges, 5 s; they stand with --friction 0.6 and fall with 0.2", arch_of_11},
      PairSceneEntry{"shirt", "a figure in a shirt walks and whirls, 10 s", shirt},
      PairSceneEntry{"tshirt", "the same in the shirt of the shared meshes, where they are, 10 s", tshirt},
      PairSceneEntry{"ball_and_curtain", "a ball is driven into a curtain at 5 m/s, or at the speed, 1 s",
                     ball_and_curtain},
      PairSceneEntry{"sleeve", "a sleeve on an arm that turns round, 3 s", sleeve}};
  return entries;
}

PairScene make_pair_scene(std::string_view name, const PairOptions& options) {
  std::string names;
  for (const PairSceneEntry& entry : pair_scenes()) {
    if (entry.name == name) return entry.make(options);
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  }
  fail_input("no scene '" + std::string(name) + "'; choose one of " + names);
}

namespace {

/// Of all bodies, one after another, and what ties pull together, whose features are neighbors.
struct AllFeatures {
  std::vector<Triangle> triangles;
  std::vector<Edge> edges;
  JoinedVertices joined;

  explicit AllFeatures(const Simulation& simulation) {
    for (const Body& body : simulation.bodies()) {
      for (Triangle each : surface_triangles(body.mesh)) {
        for (Index& vertex : each) vertex += body.first_vertex;
        triangles.push_back(each);
      }
      for (Edge each : body.mesh.edges) {
        for (Index& vertex : each) vertex += body.first_vertex;
        edges.push_back(each);
      }
    }
    joined = JoinedVertices(joints_of(simulation), simulation.state().vertex_count());
  }
  static std::vector<Joint> joints_of(const Simulation& simulation) {
    std::vector<Joint> joints;
    for (const auto& [id, group] : simulation.groups()) {
      if (!group.other) continue;
      const Real r = (simulation.contact_distance(group.body) + simulation.contact_distance(*group.other)) / 2;
      for (const auto& batch : group.set.batches) {
        const auto* ties = dynamic_cast<const Batch<AttachmentProjection>*>(batch.get());
        if (ties == nullptr) continue;
        const auto size = at(ties->shape().vertices);
        for (std::size_t i = 0; i < at(ties->shape().count); ++i) {
          if (AttachmentProjection::end_length(&ties->fields()[i * AttachmentProjection::fields]) >= r) continue;
          const std::span<const Index> stencil = ties->stencil().subspan(i * size, size);
          for (const Index corner : stencil.subspan(1)) joints.push_back({stencil[0], corner, size == 2});
        }
      }
    }
    return joints;
  }
  bool are_joined(const Crossing& crossing) const {
    return !joined.is_empty() && joined.are_joined(crossing.edge, triangles[at(crossing.triangle)]);
  }
  /// Whether the scene says that these may pass through each other.
  bool do_not_meet(const Simulation& simulation, const Crossing& crossing) const {
    const std::size_t a = body_of(simulation, crossing.edge[0]);
    const std::size_t b = body_of(simulation, triangles[at(crossing.triangle)][0]);
    const BodyContact& first = simulation.bodies()[a].contact;
    const BodyContact& second = simulation.bodies()[b].contact;
    if (a == b) return !first.self;
    const auto ignores = [](const BodyContact& contact, std::size_t other) {
      return std::ranges::find(contact.ignores, static_cast<BodyId>(other)) != contact.ignores.end();
    };
    return ignores(first, b) || ignores(second, a);
  }
  static std::size_t body_of(const Simulation& simulation, Index vertex) {
    const auto after = std::ranges::upper_bound(simulation.bodies(), vertex, {}, &Body::first_vertex);
    return static_cast<std::size_t>(after - simulation.bodies().begin()) - 1;
  }
};

}  // namespace

std::int64_t count_crossings(const Simulation& simulation) {
  const AllFeatures all(simulation);
  const std::vector<char> held = held_vertices(simulation);
  const auto is_held = [&](Index vertex) { return held[at(vertex)] != 0; };
  std::int64_t count = 0;
  visit_crossings({simulation.state().positions, all.triangles, all.edges}, [&](const Crossing& crossing) {
    const bool are_both_held = std::ranges::all_of(crossing.edge, is_held) &&
                               std::ranges::all_of(all.triangles[at(crossing.triangle)], is_held);
    if (!are_both_held && !all.are_joined(crossing) && !all.do_not_meet(simulation, crossing)) ++count;
  });
  return count;
}

std::int64_t count_unknown_crossings(const Simulation& simulation) {
  std::set<std::array<Index, 2>> known;
  for (const LetGoVertices& each : simulation.state().contact.let_go.pairs) known.insert(each.vertices);
  const AllFeatures all(simulation);
  std::int64_t count = 0;
  visit_crossings({simulation.state().positions, all.triangles, all.edges}, [&](const Crossing& crossing) {
    bool is_known = true;
    for (const Index a : crossing.edge) {
      for (const Index b : all.triangles[at(crossing.triangle)]) {
        is_known = is_known && known.contains({std::min(a, b), std::max(a, b)});
      }
    }
    if (!is_known && !all.are_joined(crossing) && !all.do_not_meet(simulation, crossing)) ++count;
  });
  return count;
}

Real total_energy(Simulation& simulation) {
  static_cast<void>(simulation.evaluate());  // elastic energies are those of the last one
  Real energy = 0;
  for (Index v = 0; v < simulation.state().vertex_count(); ++v) {
    energy += simulation.state().masses[at(v)] / 2 * row(simulation.state().velocities, v).squaredNorm();
  }
  for (const auto& [id, group] : simulation.groups()) energy += simulation.elastic_energy(id);
  for (const auto& [id, force] : simulation.forces()) energy += force->potential(simulation.state().view());
  return energy;
}

Real rms_speed(const Simulation& simulation) {
  const Positions& v = simulation.state().velocities;
  return v.rows() == 0 ? 0 : std::sqrt(v.squaredNorm() / static_cast<Real>(v.rows()));
}

}  // namespace pliant_tests
