// A step never allocates: counts what the process asks of the heap while steps are taken. Under the sanitizers, which
// have a malloc of their own, operator new alone is counted.
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <new>

#include "../collision/soups.h"
#include "../simulation/everything.h"
#include "../support/sanitizers.h"
#include "pliant/collision/colliders/builtin.h"
#include "pliant/collision/pairs/pair_search.h"
#include "pliant/collision/pairs/planes.h"
#include "pliant/core/error.h"
#include "pliant/mesh/shapes.h"
#include "pliant/timeline/timeline.h"
#ifdef PLIANT_HAS_BENCH
#include "bench/xpbd.h"
#endif

namespace {

std::atomic<long> allocations = 0;

}  // namespace

#if !PLIANT_IS_SANITIZED
extern "C" {
// NOLINTBEGIN(readability-identifier-naming): glibc's names for what is behind malloc
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
// NOLINTEND(readability-identifier-naming)

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  ++allocations;
  return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
}
#else
#if !defined(__clang__)
// Inlined, a pair of these looks to GCC as if the one did not belong to the other.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
#endif
void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
// std::stable_sort asks by this for its buffer, and does without where there is none.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, const std::nothrow_t&) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
#endif

using namespace pliant;

namespace {

/// Allocations in ten steps after two of warming up, and with late pins one more.
long allocations_of(const SolverSettings& settings, bool has_late_pins) {
  const bool is_bdf2 = settings.integrator == Integrator::bdf2;
  SolverSettings first = settings;
  first.integrator = Integrator::implicit_euler;
  Simulation simulation = pliant_tests::everything(first, 12);
  if (is_bdf2) simulation.remove(simulation.find_force("mouse_spring").value());
  simulation.set_settings(settings);
  // Motions under way and an event to come are no events.
  Timeline timeline;
  timeline.start(simulation, GroupId{5}, rigid_path({{.time = 9, .rotate = {{0, 0, 1}, 30}}}), {1});
  timeline.start(simulation, GroupId{6}, follow_body(BodyId{1}));
  timeline.add(When::at_time(99), [](Simulation&) {});
  for (int i = 0; i < 2; ++i) timeline.step(simulation);
  if (has_late_pins) {
    const BodyId cloth{0};
    simulation.add(cloth, Position{.on = {50, 51}});
    simulation.add(cloth, Position{.on = {70}, .hold = Hold::soft});
    timeline.step(simulation);
  }
  const long before = allocations;
  for (int i = 0; i < 10; ++i) {
    simulation.set_target(GroupId{5}, 0, Vec3(0, 0.01 * i, 1));
    timeline.step(simulation);
  }
  return allocations - before;
}

/// Allocations in steps of a cloth that falls on colliders, once its contacts have been what they can be: the third
/// time that it does so.
long allocations_of_contact(Index threads) {
  Simulation simulation({.threads = threads});
  Mesh mesh = grid({.columns = 24, .rows = 24, .plane = Plane::xy});
  mesh.vertices.rowwise() += Eigen::RowVector3d(-0.48, -0.51, 0.25);
  const BodyId cloth = simulation.add_body(std::move(mesh), Mass::area_density(0.2));
  simulation.add(cloth, TriangleStrain{});
  simulation.add(Gravity{});
  simulation.add(SphereCollider{.radius = 0.2, .angular_velocity = {0, 0, 1}});
  simulation.add(PlaneCollider{.position = {0, 0, -0.2}});
  const State start = simulation.state();
  long count = 0;
  for (int time = 0; time < 3; ++time) {
    simulation.restore(start);
    simulation.step();
    const long before = allocations;
    for (int i = 0; i < 60; ++i) simulation.step();
    count = allocations - before;
  }
  return count;
}

/// Allocations in searches for pairs of a sheet that is rolled up, whose trees are built anew on the way: the third
/// time that it is.
long allocations_of_pairs(int threads) {
  ThreadPool pool(threads);
  const Mesh mesh = grid({.columns = 60, .rows = 60});
  const SurfacePart part{.vertex_count = mesh.vertex_count(), .triangles = mesh.triangles};
  const Surface surface(std::span(&part, 1), mesh.vertex_count(), {});
  PairSearch search(surface);
  const std::vector<Real> pads(at(mesh.vertex_count()), 0.01);
  Positions x = mesh.vertices;
  long count = 0;
  for (int time = 0; time < 3; ++time) {
    const std::int64_t builds = search.build_count();
    const long before = allocations;
    for (int i = 0; i < 20; ++i) {
      for (Index v = 0; v < x.rows(); ++v) {
        const Real angle = 0.5 * i * mesh.vertices(v, 0);
        x.row(v) = mesh.vertices.row(v) * (1 + 0.1 * i) + Eigen::RowVector3d(std::cos(angle), 0, std::sin(angle));
      }
      search.find(x, x, pads, pool);
    }
    count = allocations - before;
    if (search.build_count() == builds) count = 1000000;  // then nothing was tested
  }
  return count;
}

/// Allocations while planes keep surfaces apart, the second time.
long allocations_of_planes(int threads) {
  pliant_tests::Random random(1);
  pliant_tests::Soup soup = pliant_tests::random_soup(random, 24);
  soup.finish(0.03);
  const Positions wishes = soup.q + random.positions(static_cast<Index>(soup.q.rows()), 0.5);
  ThreadPool pool(threads);
  Planes planes;
  Positions y = wishes;
  const PlanesInput input{.begin = soup.q, .surface = soup.surface, .pairs = soup.pairs, .radii = soup.radii};
  if (planes.shorten(input, y, pool).vertices == 0) return -1;
  y = wishes;
  const long before = allocations;
  planes.shorten(input, y, pool);
  return allocations - before;
}

/// Allocations in steps of a sheet that falls onto another one that hangs by its corners, the third time.
long allocations_of_surfaces(Index threads) {
  Simulation simulation({.threads = threads});
  simulation.add(Gravity{});
  simulation.set_contact({.friction = 0.3, .surfaces = true});
  for (const Real width : {1.0, 0.6}) {
    Mesh mesh = grid({.columns = 11, .rows = 11, .size = {width, width}, .plane = Plane::xy});
    mesh.vertices.rowwise() += Eigen::RowVector3d(0.23 * (1 - width), 0.21 * (1 - width), 0.1 * (1 - width));
    const BodyId body = simulation.add_body(std::move(mesh), Mass::area_density(0.2));
    simulation.add(body, TriangleStrain{});
    if (width == 1) simulation.add(body, Position{.on = {0, 10, 110, 120}});
  }
  const State start = simulation.state();
  long count = 0;
  for (int time = 0; time < 3; ++time) {
    simulation.restore(start);
    Index active = simulation.step().contact.active;
    const long before = allocations;
    for (int i = 0; i < 40; ++i) active += simulation.step().contact.active;
    count = allocations - before;
    if (active == 0) count = 1000000;  // then nothing was tested
  }
  return count;
}

#ifdef PLIANT_HAS_BENCH
long allocations_of_sweeps() {
  Simulation simulation;
  const BodyId body = simulation.add_body(grid({.columns = 5, .rows = 5}), Mass::per_vertex(1));
  simulation.add(body, TriangleStrain{});
  simulation.add(body, HingeBending{});
  simulation.add(body, Position{.on = {0}, .hold = Hold::soft});
  pliant_bench::Xpbd one(simulation, pliant_bench::Multipliers::one);
  pliant_bench::Xpbd each_row(simulation, pliant_bench::Multipliers::each_row);
  const long before = allocations;
  for (pliant_bench::Xpbd* xpbd : {&one, &each_row}) {
    xpbd->begin_step();
    for (int i = 0; i < 3; ++i) xpbd->sweep();
  }
  return allocations - before;
}
#endif

/// Prints what went wrong; true when nothing did.
bool passes(const SolverSettings& settings) {
  try {
    const long count = allocations_of(settings, false) + allocations_of(settings, true);
    if (count == 0) return true;
    std::printf("%ld allocations with back end %d, %d threads, integrator %d, %d substeps, energy %g\n", count,
                static_cast<int>(settings.backend), settings.threads, static_cast<int>(settings.integrator),
                settings.substeps, settings.energy_projection);
    return false;
  } catch (const Error& error) {
    std::printf("skipped: %s\n", error.what());
    return settings.backend == Backend::cholmod;
  }
}

}  // namespace

int main() {
  const long before = allocations;
  ::operator delete(::operator new(8));
  if (allocations == before) {
    std::puts("the counter does not count");
    return 1;
  }
  bool all_pass = true;
  for (const Backend backend : {Backend::eigen, Backend::cholmod}) {
    for (const Index threads : {1, 2}) {
      for (const Start start : {Start::prediction, Start::positions, Start::adaptive}) {
        all_pass = passes({.start = start, .backend = backend, .threads = threads}) && all_pass;
      }
      for (const Acceleration acceleration : {Acceleration::lbfgs, Acceleration::anderson, Acceleration::chebyshev}) {
        all_pass = passes({.iterations = 12, .acceleration = acceleration, .backend = backend, .threads = threads}) &&
                   all_pass;
      }
      all_pass = passes({.energy_projection = 1, .backend = backend, .threads = threads}) && all_pass;
      for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
        const SolverSettings settings{
            .integrator = integrator, .substeps = 3, .damping = 2, .backend = backend, .threads = threads};
        all_pass = passes(settings) && all_pass;
      }
    }
  }
  for (const Index threads : {1, 2}) {
    const long count = allocations_of_contact(threads);
    if (count > 0) std::printf("%ld allocations with contact, %d threads\n", count, threads);
    const long of_planes = allocations_of_planes(threads);
    if (of_planes != 0) std::printf("%ld allocations of planes between surfaces, %d threads\n", of_planes, threads);
    const long of_surfaces = allocations_of_surfaces(threads);
    if (of_surfaces > 0) std::printf("%ld allocations with contact of surfaces, %d threads\n", of_surfaces, threads);
    all_pass = all_pass && count == 0 && of_planes == 0 && of_surfaces == 0;
  }
  for (const int threads : {1, 2}) {
    const long count = allocations_of_pairs(threads);
    if (count > 0) std::printf("%ld allocations in searches for pairs, %d threads\n", count, threads);
    all_pass = all_pass && count == 0;
  }
#ifdef PLIANT_HAS_BENCH
  const long of_sweeps = allocations_of_sweeps();
  if (of_sweeps > 0) std::printf("%ld allocations in sweeps of XPBD\n", of_sweeps);
  all_pass = all_pass && of_sweeps == 0;
#endif
  return all_pass ? 0 : 1;
}
