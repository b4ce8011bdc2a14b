// A window on a program's own simulation: a cloth that hangs from a rail, which a motor turns, and a magnet, a type of
// force of this program's own. Its options are sliders in the window like those of the built-in types. Given a number,
// the window closes after so many simulated seconds.
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <vector>

#include <pliant/pliant.h>
#include <pliant_viewer/pliant_viewer.h>

namespace {

using pliant::Index;
using pliant::Vec3;

//! [own_force]
/// Draws every vertex to a point.
struct Magnet {
  static constexpr pliant::ForceInfo info{"magnet", "s m (c − x) / (‖c − x‖² + 0.01 m²)", "",
                                          pliant::ForceReach::bodies};
  double strength = 3;       // s [m²/s²]
  Vec3 center{0.5, 1, 0.4};  // c [m]

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(pliant::OptionInfo{"strength", "m²/s²", "a negative one pushes away", pliant::Range{-20, 20}}, self.strength);
    field(pliant::OptionInfo{"center", "m", "where it is"}, self.center);
  }
};

class MagnetForce final : public pliant::Force {
 public:
  explicit MagnetForce(const Magnet& magnet) : magnet_(magnet) {}
  std::string_view type() const override { return Magnet::info.name; }
  void add_to(pliant::Positions& forces, const pliant::StateView& state, double) override {
    for (Index i = 0; i < static_cast<Index>(forces.rows()); ++i) {
      const Vec3 way = magnet_.center - pliant::row(state.positions, i);
      const double mass = state.masses[static_cast<std::size_t>(i)];
      forces.row(i) += (magnet_.strength * mass / (way.squaredNorm() + 0.01) * way).transpose();
    }
  }
  std::unique_ptr<Force> copy() const override { return std::make_unique<MagnetForce>(*this); }

 private:
  Magnet magnet_;
};

std::unique_ptr<pliant::Force> build(const pliant::ForceScope&, const Magnet& magnet) {
  pliant::check_options(Magnet::info.name, magnet);
  return std::make_unique<MagnetForce>(magnet);
}
//! [own_force]

constexpr Index side = 50;

/// The last row of the grid.
std::vector<Index> top_row() {
  std::vector<Index> row;
  for (Index i = 0; i < side; ++i) row.push_back(side * (side - 1) + i);
  return row;
}

}  // namespace

int main(int argc, char** argv) try {
  //! [window]
  pliant::Scene scene;
  scene.name = "magnet";
  pliant::Simulation& simulation = scene.simulation;
  simulation.set_settings(pliant::settings_for_materials());
  const pliant::Material& cotton = pliant::builtin_material("cotton");
  const auto cloth =
      simulation.add_body(pliant::grid({.columns = side, .rows = side}), pliant::mass_of(cotton), {.name = "cloth"});
  pliant::add_material(simulation, cloth, cotton);
  scene.materials[cloth] = cotton;
  const auto rail = simulation.add(cloth, pliant::Position{.on = top_row()}, "rail");
  simulation.set_contact({});  // the cloth touches itself
  simulation.add(pliant::Gravity{});
  simulation.add(cloth, pliant::Wind{.velocity = {0, 0, 0}, .drag = 0.3});  // still air
  simulation.add(Magnet{});

  pliant::ViewOptions options;
  const auto turn_rail = [rail](pliant::Simulation& moving) {
    if (!moving.groups().contains(rail)) return;  // switched off in the window
    const double angle = 0.6 * std::sin(moving.state().time);
    const std::vector<Index>& points = moving.groups().at(rail).points;  // those that were not let go
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double way = static_cast<double>(points[i]) / (side - 1) - 0.5;
      moving.set_target(rail, static_cast<Index>(i), {0.5 + way * std::cos(angle), way * std::sin(angle), 1});
    }
  };
  options.before_step = turn_rail;
  //! [window]
  const double end = argc > 1 ? std::atof(argv[1]) : std::numeric_limits<double>::infinity();
  std::atomic<bool> is_over = false;
  options.before_step = [&](pliant::Simulation& moving) {
    turn_rail(moving);
    is_over = is_over || moving.state().time >= end;
  };
  options.should_close = [&] { return is_over.load(); };
  //! [view]
  pliant::view(scene, options);  // returns once the window is closed
  std::printf("closed after %.2f simulated seconds\n", simulation.state().time);
  //! [view]
  return argc > 1 && simulation.state().time < end ? 1 : 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "error: %s\n", error.what());
  return 1;
}
