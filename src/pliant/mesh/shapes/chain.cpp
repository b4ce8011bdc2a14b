#include "pliant/mesh/shapes/chain.h"

#include "pliant/mesh/shapes/limits.h"

namespace pliant {

Mesh chain(const ChainOptions& options) {
  check_options(options.shape, options);
  require_vertex_count("chain: links", options.links + Real{1});
  if (options.direction.isZero(0)) fail_input("chain: direction is (0, 0, 0); give one of any other length");

  Mesh mesh;
  mesh.vertices.resize(options.links + 1, 3);
  const Vec3 span = options.length * options.direction.stableNormalized();
  for (Index v = 0; v <= options.links; ++v) {
    mesh.vertices.row(v) = (Real{1} * v / options.links * span).transpose();
    if (v > 0) mesh.edges.push_back({v - 1, v});
  }
  return mesh;
}

}  // namespace pliant
