// What experiments are given: scenes without contact, and disturbances too small to be seen.
#include <doctest/doctest.h>

#include "experiments/convergence/descent.h"
#include "experiments/experiment_context.h"
#include "experiments/support/claims.h"
#include "pliant/simulation/held.h"
#include "pliant_io/scene/builtin_scenes.h"

namespace test_context {

using namespace pliant_experiments;
using pliant_report::Verdict;

TEST_CASE("every built-in scene can be had without contact and winds, and takes a step") {
  const ExperimentContext context({});
  bool has_colliders = false;
  for (const pliant::BuiltinScene& builtin : pliant::builtin_scenes()) {
    const std::string name(builtin.name);
    CAPTURE(name);
    has_colliders = has_colliders || !context.builtin_scene(builtin.name).simulation.colliders().empty();
    pliant::Scene scene = context.builtin_scene_without_contact(builtin.name, Winds::left_out);
    CHECK(scene.simulation.colliders().empty());
    for (const auto& [id, force] : scene.simulation.forces()) {
      CHECK(force->type() != "wind");
    }
    CHECK(context.step(scene).contact.contacts == 0);
    CHECK(context.builtin_scene_without_contact(builtin.name, Winds::kept).simulation.bodies().size() ==
          scene.simulation.bodies().size());
  }
  CHECK(has_colliders);
}

TEST_CASE("a disturbance moves what no pin holds, by at most a millionth of a meter, the same for the same seed") {
  const auto disturbed = [](unsigned seed, unsigned repeat) {
    const ExperimentContext context({.seed = seed});
    pliant::Scene scene = context.builtin_scene("net");
    context.disturb(scene, repeat);
    return scene.simulation.state().positions;
  };
  const ExperimentContext context({});
  const pliant::Scene scene = context.builtin_scene("net");
  const pliant::Positions& start = scene.simulation.state().positions;
  const std::vector<char> held = pliant::held_vertices(scene.simulation);
  CHECK(disturbed(0, 0) == start);
  CHECK(disturbed(3, 1) == disturbed(3, 1));
  CHECK(disturbed(3, 1) != disturbed(3, 0));
  CHECK(disturbed(3, 0) != disturbed(2, 0));
  const pliant::Positions moved = disturbed(1, 0);
  for (Eigen::Index i = 0; i < start.rows(); ++i) {
    const double way = (moved.row(i) - start.row(i)).cwiseAbs().maxCoeff();
    if (held[static_cast<std::size_t>(i)] != 0) {
      CHECK(way == 0);
    } else {
      CHECK(way > 0);
      CHECK(way <= 1e-6);
    }
  }
}

TEST_CASE("the error after a time is that of the last run that had ended by then, whatever an earlier one took") {
  const Descent descent{.iterations = {1, 2, 4},
                        .seconds = {1, 8, 4},
                        .most_seconds = {1, 8, 16},
                        .objective_errors = {0.1, 0.01, 0.0001},
                        .position_errors = {}};
  CHECK(descent.objective_error_at(0.5) == 1);
  CHECK(descent.objective_error_at(4) == doctest::Approx(0.0001));
  CHECK(descent.objective_error_at(100) == doctest::Approx(0.0001));
  CHECK(descent.objective_error_at(1, descent.most_seconds) == doctest::Approx(0.1));
  CHECK(descent.objective_error_at(8, descent.most_seconds) == doctest::Approx(0.01));
  CHECK(descent.objective_error_at(std::sqrt(8 * 16.0), descent.most_seconds) == doctest::Approx(0.001));
}

TEST_CASE("a limit that lies within the noise of repeats is neither kept nor broken") {
  CHECK(at_most("", spread({1, 1.1, 1.2, 1.2}), 1.3, "").verdict == Verdict::holds);
  CHECK(at_most("", spread({1.4, 1.5, 1.6, 1.7}), 1.3, "").verdict == Verdict::fails);
  const pliant_report::Claim claim = at_most("", spread({1.1, 1.2, 1.4, 1.5}), 1.3, "1.3 times");
  CHECK(claim.verdict == Verdict::reported);
  CHECK(claim.evidence.find("within the noise") != std::string::npos);
  CHECK(times_text(spread({1, 2, 3}), spread({2, 3, 4}), "ms") ==
        "2.00 in place of 3.00 ms, a difference within the noise");
  CHECK(times_text(spread({1, 1, 1}), spread({2, 3, 4}), "ms") == "1.00 in place of 3.00 ms");
}

}  // namespace test_context
