#include <cstring>

#include <doctest/doctest.h>

#include "../simulation/everything.h"
#include "../simulation/run.h"
#include "pliant/core/error.h"

namespace test_threads {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// All bits that a run leaves behind.
std::vector<Real> bits_of(Simulation& simulation) {
  const Evaluation end = simulation.evaluate();
  std::vector<Real> bits = {end.residual, end.inertia, end.elastic};
  for (const Positions* x : {&simulation.state().positions, &simulation.state().velocities}) {
    bits.insert(bits.end(), x->data(), x->data() + x->size());
  }
  bits.insert(bits.end(), simulation.objective_history().begin(), simulation.objective_history().end());
  return bits;
}

bool same_bits(const std::vector<Real>& a, const std::vector<Real>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Real)) == 0;
}

std::vector<Real> run(Index threads, Backend backend) {
  Simulation simulation = everything({.iterations = 4, .backend = backend, .threads = threads}, 40);
  advance(simulation, 4);
  if (threads > 0) CHECK(simulation.thread_count() == threads);
  return bits_of(simulation);
}

}  // namespace

TEST_CASE("the same bits for any number of threads, and from run to run") {
  Index constraints = 0;
  const Simulation large = everything({}, 40);
  for (const auto& [id, group] : large.groups()) constraints += group.set.count;
  CHECK(constraints > 20000);
  for (const Backend backend : {Backend::eigen, Backend::cholmod}) {
    try {
      const std::vector<Real> bits = run(1, backend);
      for (const Index threads : {1, 2, 3, 8, 0}) {
        CAPTURE(threads);
        CHECK(same_bits(run(threads, backend), bits));
      }
    } catch (const Error& error) {
      MESSAGE("skipped: ", std::string(error.what()));
    }
  }
}

TEST_CASE("a change of the number of threads between steps changes nothing") {
  Simulation changed = everything({.iterations = 4, .threads = 1}, 40);
  Simulation same = everything({.iterations = 4, .threads = 1}, 40);
  for (const Index threads : {2, 3, 1, 8}) {
    SolverSettings settings = changed.settings();
    settings.threads = threads;
    changed.set_settings(settings);
    changed.step();
    same.step();
    CHECK(changed.thread_count() == threads);
    CHECK(same_bits(bits_of(changed), bits_of(same)));
  }
}

TEST_CASE("two simulations in one process do not touch each other") {
  const auto make = [](int which) {
    return everything({.iterations = which == 0 ? 3 : 5, .threads = which + 1}, which == 0 ? 12 : 9);
  };
  std::array<std::vector<Real>, 2> alone;
  for (int which = 0; which < 2; ++which) {
    Simulation simulation = make(which);
    advance(simulation, 10);
    alone[static_cast<std::size_t>(which)] = bits_of(simulation);
  }
  Simulation first = make(0);
  Simulation second = make(1);
  for (int i = 0; i < 10; ++i) {
    first.step();
    second.step();
  }
  CHECK(same_bits(bits_of(first), alone[0]));
  CHECK(same_bits(bits_of(second), alone[1]));
}

TEST_CASE("a simulation goes on where it was after it has been moved") {
  Simulation stayed = everything({.iterations = 3}, 8);
  Simulation original = everything({.iterations = 3}, 8);
  advance(stayed, 6);
  advance(original, 3);
  Simulation elsewhere = std::move(original);
  advance(elsewhere, 3);
  CHECK(same_bits(bits_of(elsewhere), bits_of(stayed)));
}

}  // namespace test_threads
