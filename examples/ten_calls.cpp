// The ten calls that docs/cpp.md explains, as one program: the page quotes the parts between the markers.
#include <cstdio>

#include <pliant/pliant.h>
#include <pliant_io/pliant_io.h>

int main() {
  try {
    //! [settings]
    pliant::Simulation simulation({.time_step = 1.0 / 60, .iterations = 20});
    //! [settings]

    const pliant::Mesh sheet = pliant::grid({.columns = 21, .rows = 21});
    pliant::write_obj("cloth.obj", sheet, sheet.vertices);
    //! [body]
    const pliant::Mesh mesh = pliant::read_mesh("cloth.obj", {.scale = 1, .up = pliant::UpAxis::z});
    const auto cloth = simulation.add_body(mesh, pliant::Mass::area_density(0.2));  // kg/m²
    //! [body]

    //! [constraints]
    const auto weave = simulation.add(cloth, pliant::TriangleStrain{.stiffness = 1000});  // N/m
    simulation.add(cloth, pliant::Bending{.stiffness = 1e-3});                            // N·m
    const auto pins = simulation.add(cloth, pliant::Position{.on = {420, 440}});          // two vertices
    //! [constraints]

    //! [forces]
    simulation.add(pliant::Gravity{});
    simulation.add(pliant::Wind{.velocity = {0, 2, 0}});  // m/s
    //! [forces]

    //! [step]
    for (int i = 0; i < 60; ++i) simulation.step();
    //! [step]

    //! [state]
    const pliant::Positions& positions = simulation.state().positions;  // vertices x 3, in meters
    std::printf("%.2f s: the lowest vertex is at %.3f m\n", simulation.state().time, positions.col(2).minCoeff());
    //! [state]

    //! [stiffness]
    simulation.set_stiffness(weave, 4000);
    //! [stiffness]

    //! [pins]
    simulation.set_target(pins, 0, pliant::Vec3(0.2, 0, 1));  // the first pin of the group, from the next step on
    const pliant::Index released = 440;
    simulation.release(pins, {&released, 1});
    //! [pins]
    for (int i = 0; i < 60; ++i) simulation.step();

    //! [evaluate]
    const pliant::Evaluation evaluation = simulation.evaluate();
    std::printf("residual %.2g N, elastic energy %.3g J\n", evaluation.residual, evaluation.elastic);
    //! [evaluate]

    //! [write]
    pliant::write_mesh("cloth.ply", simulation.body(cloth).mesh, simulation.state().positions);
    //! [write]
    //! [errors]
  } catch (const pliant::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());  // one line: what, where, remedy
    return static_cast<int>(error.kind());
  }
  //! [errors]
  return 0;
}
