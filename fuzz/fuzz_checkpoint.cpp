// Checkpoints, as they come and with a checksum that fits: an Error or a scene that goes on with finite positions.
#include "fuzz.h"
#include "pliant_io/checkpoint/checkpoint.h"
// Private to the library, and the only way behind the checksum, which no mutation meets.
#include "pliant_io/checkpoint/detail/checkpoint_file.h"

namespace {

void resume(std::string_view bytes) {
  pliant_fuzz::expect_errors_only([&] {
    pliant::Scene scene = pliant::parse_checkpoint(bytes, "fuzz.pliant", {.threads = 1});
    for (int step = 0; step < 2; ++step) {
      const pliant::Simulation& simulation = scene.simulation;
      if (simulation.state().vertex_count() > 500 || simulation.settings().iterations > 20) return;
      pliant_fuzz::require(simulation.state().positions.allFinite(), "a position is not finite");
      scene.step();
    }
    pliant_fuzz::require(scene.simulation.state().positions.allFinite(), "a position is not finite after a step");
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t header_size = 24;
  const std::string_view bytes = pliant_fuzz::text(data, size);
  resume(bytes);
  if (size < header_size) return 0;
  if (const std::string sealed = pliant::seal(bytes.substr(header_size)); sealed != bytes) resume(sealed);
  return 0;
}
