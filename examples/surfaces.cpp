// A scarf falls onto a ball that turns and carries it round, with a tag that lies on neither: docs/contact.md quotes
// the parts between the markers.
#include <cstdio>

#include <pliant/pliant.h>

namespace {

pliant::Mesh square(pliant::Index side, double width, double height) {
  pliant::Mesh mesh = pliant::grid({.columns = side, .rows = side, .size = {width, width}, .plane = pliant::Plane::xy});
  mesh.vertices.rowwise() += pliant::Vec3(-width / 2, -width / 2, height).transpose();
  return mesh;
}

}  // namespace

int main() {
  pliant::Simulation simulation({.iterations = 20});
  const auto add_cloth = [&](const pliant::Mesh& mesh) {
    const auto body = simulation.add_body(mesh, pliant::Mass::area_density(0.3));
    simulation.add(body, pliant::TriangleStrain{.stiffness = 500});
    simulation.add(body, pliant::Bending{.stiffness = 1e-5});
    return body;
  };
  //! [animated_body]
  pliant::Timeline timeline;
  const auto ball = simulation.add_body(pliant::sphere({.radius = 0.2}), pliant::Mass::area_density(1));
  pliant::animate(simulation, timeline, ball, pliant::steady_path({0, 0, 0}, {0, 0, 1}));  // m/s, rad/s
  //! [animated_body]
  const auto scarf = add_cloth(square(21, 0.8, 0.23));
  const auto tag = add_cloth(square(4, 0.1, 0.24));
  simulation.add(pliant::Gravity{});

  //! [body_contact]
  simulation.set_contact({.friction = 0.3});
  simulation.set_contact(scarf, {.distance = 0.008, .friction = 0.6});
  simulation.set_contact(tag, {.self = false, .ignores = {scarf}});
  //! [body_contact]

  pliant::StepReport report;
  for (int i = 0; i < 40; ++i) report = timeline.step(simulation);
  std::printf("%d pairs push, the nearest surfaces are %.2f mm apart\n", report.contact.active,
              1e3 * report.contact.smallest_gap);
  return report.contact.active > 0 && report.contact.smallest_gap > 0 ? 0 : 1;
}
