// Scene files, read and simulated for two steps where they are small: whatever the bytes are, an Error or finite
// positions.
#include "fuzz.h"
#include "pliant_io/scene/scene.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  pliant_fuzz::expect_errors_only([&] {
    pliant::Scene scene = pliant::parse_scene(pliant_fuzz::text(data, size), pliant_fuzz::scene_folder(), "fuzz.json",
                                              {.steps = 2, .iterations = 2, .threads = 1});
    if (scene.simulation.state().vertex_count() > 500) return;
    for (std::int64_t i = 0; i < scene.steps; ++i) scene.step();
    pliant_fuzz::require(scene.simulation.state().positions.allFinite(), "a position is not finite");
  });
  return 0;
}
