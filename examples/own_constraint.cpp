// A constraint type of one's own, outside the library: a vertex stays on or above a sphere. It is a struct with its
// rest data and one projection; batches, gathering, the system matrix and threads are the library's.
#include <cmath>
#include <cstdio>

#include <pliant/pliant.h>
#include <pliant_io/pliant_io.h>

namespace {

/// z = x, p = x outside the sphere, else the nearest point of its surface.
struct OutsideSphere {
  static constexpr std::string_view name = "outside_sphere";
  static constexpr int vertices = 1;
  static constexpr int rows = 1;
  static constexpr int fields = 4;  // center, radius
  static constexpr bool translation_invariant = false;
  static void project(const double* field, const double* z, double* p) {
    const double d[3] = {z[0] - field[0], z[1] - field[1], z[2] - field[2]};
    const double distance = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const double scale = distance > 0 && distance < field[3] ? field[3] / distance : 1;
    for (int axis = 0; axis < 3; ++axis) p[axis] = field[axis] + scale * d[axis];
  }
};

pliant::ConstraintSet outside_sphere(pliant::Index vertex_count, const std::array<double, 4>& sphere) {
  auto batch = std::make_unique<pliant::Batch<OutsideSphere>>(1e4);  // N/m
  const double one = 1;
  for (pliant::Index i = 0; i < vertex_count; ++i) batch->add({&i, 1}, {&one, 1}, 1, sphere);
  pliant::ConstraintSet set;
  set.count = vertex_count;
  set.batches.push_back(std::move(batch));
  return set;
}

}  // namespace

int main() {
  pliant::Simulation simulation({.iterations = 20});
  const auto cloth = simulation.add_body(pliant::grid({.columns = 30, .rows = 30, .plane = pliant::Plane::xy}),
                                         pliant::Mass::area_density(0.2));
  simulation.add(cloth, pliant::EdgeSpring{.stiffness = 1e3});
  simulation.add(cloth, pliant::Position{.on = {0, 29, 870, 899}});
  const std::array<double, 4> sphere = {0.5, 0.5, -0.3, 0.3};
  simulation.add_set(cloth, outside_sphere(simulation.state().vertex_count(), sphere), "outside_sphere");
  simulation.add(pliant::Gravity{});
  for (int i = 0; i < 90; ++i) simulation.step();

  const pliant::Vec3 center(sphere[0], sphere[1], sphere[2]);
  const auto& x = simulation.state().positions;
  const double nearest = (x.rowwise() - center.transpose()).rowwise().norm().minCoeff();
  pliant::write_obj("draped.obj", simulation.body(cloth).mesh, x);
  std::printf("draped.obj: a cloth on a sphere of .3 m; its nearest vertex is %.3f m from the center\n", nearest);
  return nearest > 0.29 && nearest < 0.31 ? 0 : 1;
}
