#include <algorithm>
#include <cmath>

#include "bench/measure.h"
#include "bench/timing.h"
#include "pliant/core/stopwatch.h"
#include "pliant/pliant.h"

namespace pliant_bench {
namespace {

using namespace pliant;

constexpr Index constraints_at_once = 1024;  // as the local step has them
constexpr double seconds_for_all = 2;

/// One type on one body.
struct Kernel {
  std::string type;
  Simulation simulation;
  std::vector<Real> slots;
  Samples samples;

  double seconds() {
    const Positions& positions = simulation.state().positions;
    const Stopwatch watch;
    for (const auto& [id, group] : simulation.groups()) {
      for (const auto& batch : group.set.batches) project(*batch, positions);
    }
    return watch.seconds();
  }
  void project(const ConstraintGroup& group, const Positions& positions) {
    const GroupShape shape = group.shape();
    for (Index begin = 0; begin < shape.count; begin += constraints_at_once) {
      const Index end = std::min(shape.count, begin + constraints_at_once);
      project_to_slots(group, positions, slots, begin, end);  // the same slots for all, as the local step has them
    }
  }
};

Mesh sheet() {
  return grid({.columns = 100, .rows = 100, .size = {1, 1}});
}

/// Rest shapes of curved constraints are no constant quadratics: they have a projection.
Mesh wavy_sheet() {
  Mesh mesh = sheet();
  for (Index i = 0; i < mesh.vertex_count(); ++i) {
    mesh.vertices(i, 1) += 0.1 * std::sin(9 * mesh.vertices(i, 0)) * std::cos(7 * mesh.vertices(i, 2));
  }
  return mesh;
}

Mesh block() {
  return bar({.cells = {40, 10, 10}, .size = {4, 1, 1}, .cut = TetrahedronCut::five});
}

template <class Constraint>
Kernel make_kernel(std::string type, Mesh mesh, const Constraint& constraint) {
  Positions start = mesh.vertices;
  for (Index i = 0; i < static_cast<Index>(start.rows()); ++i) {
    start(i, 0) += 0.02 * std::sin(13 * mesh.vertices(i, 2));
    start(i, 1) += 0.03 * std::sin(11 * mesh.vertices(i, 0));
  }
  Kernel kernel{std::move(type), Simulation(), {}, {}};
  const BodyId body = kernel.simulation.add_body(std::move(mesh), Mass::per_vertex(1), {.start = std::move(start)});
  kernel.simulation.add(body, constraint);
  std::size_t most = 0;
  for (const auto& batch : kernel.simulation.groups().begin()->second.set.batches) {
    const GroupShape shape = batch->shape();
    most = std::max(most, 3 * static_cast<std::size_t>(constraints_at_once) *
                              static_cast<std::size_t>(std::max(shape.rows, shape.vertices)));
  }
  kernel.slots.resize(most);
  return kernel;
}

}  // namespace

std::vector<ProjectionsResult> measure_projections(std::optional<int> repeats) {
  std::vector<Kernel> kernels;
  kernels.push_back(make_kernel("edge_spring", sheet(), EdgeSpring{}));
  kernels.push_back(make_kernel("edge_strain", sheet(), EdgeStrain{}));
  kernels.push_back(make_kernel("triangle_strain", sheet(), TriangleStrain{}));
  kernels.push_back(make_kernel("fibre_strain", sheet(), FibreStrain{}));
  kernels.push_back(make_kernel("triangle_area", sheet(), TriangleArea{}));
  kernels.push_back(make_kernel("tetrahedron_strain", block(), TetrahedronStrain{}));
  kernels.push_back(make_kernel("tetrahedron_volume", block(), TetrahedronVolume{}));
  kernels.push_back(make_kernel("triangle_neo_hookean", sheet(), TriangleNeoHookean{}));
  kernels.push_back(make_kernel("triangle_stvk", sheet(), TriangleStvk{}));
  kernels.push_back(make_kernel("tetrahedron_neo_hookean", block(), TetrahedronNeoHookean{}));
  kernels.push_back(make_kernel("tetrahedron_stvk", block(), TetrahedronStvk{}));
  kernels.push_back(make_kernel("bending, flat at rest", sheet(), Bending{}));
  kernels.push_back(make_kernel("bending, curved at rest", wavy_sheet(), Bending{}));
  kernels.push_back(make_kernel("hinge, flat at rest", sheet(), HingeBending{}));
  kernels.push_back(make_kernel("hinge, curved at rest", wavy_sheet(), HingeBending{}));
  kernels.push_back(make_kernel("triangle_bending, flat at rest", sheet(), TriangleBending{}));
  kernels.push_back(make_kernel("triangle_bending, curved at rest", wavy_sheet(), TriangleBending{}));
  for (Kernel& kernel : kernels) kernel.seconds();
  repeat(repeats, seconds_for_all, [&] {
    for (Kernel& kernel : kernels) kernel.samples.add(kernel.seconds());
  });
  std::vector<ProjectionsResult> results;
  for (const Kernel& kernel : kernels) {
    results.push_back({kernel.type, kernel.simulation.groups().begin()->second.set.count, kernel.samples.spread()});
  }
  return results;
}

}  // namespace pliant_bench
