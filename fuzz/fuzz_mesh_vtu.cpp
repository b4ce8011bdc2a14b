// VTK's files of XML; fuzz_mesh.h has what is promised of their meshes.
#include "fuzz_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return pliant_fuzz::fuzz_mesh(data, size, pliant::require_mesh_format("x.vtu"));
}
