// What the experiment on contact compares sheets with: a point on a plane, in steps.
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "experiments/contact/sheet_on_plane.h"

namespace test_sliding_point {

namespace {

using namespace pliant_experiments;

constexpr double h = 1.0 / 60;

ContactMethod euler(pliant::Index substeps = 1) {
  return {.substeps = substeps};
}

}  // namespace

TEST_CASE("a sliding point goes as far as the sum over implicit Euler's steps") {
  for (const pliant::Index substeps : {1, 4}) {
    SlidingPoint point(euler(substeps), {.pull = 5, .friction = 3});
    for (int i = 0; i < 60; ++i) point.step();
    const double n = 60.0 * substeps;
    CHECK(point.way() == doctest::Approx(h * h / (substeps * substeps) * n * (n + 1) / 2 * 2).epsilon(1e-12));
    CHECK(point.speed() == doctest::Approx(2).epsilon(1e-12));
  }
}

TEST_CASE("a point that friction holds stays where it is, and one that slides comes to rest and stays") {
  SlidingPoint held(euler(), {.pull = 2.9, .friction = 3});
  SlidingPoint stopping({.integrator = pliant::Integrator::bdf2}, {.friction = 3, .speed = 1});
  double way = 0;
  for (int i = 0; i < 60; ++i) {
    held.step();
    stopping.step();
    if (i == 40) way = stopping.way();
  }
  CHECK(held.way() == 0);
  CHECK(stopping.way() == doctest::Approx(way).epsilon(1e-12));
  CHECK(std::abs(stopping.way() - 1.0 / 6) < 0.01);  // v²/2μg
}

TEST_CASE("the ground takes a point along, no faster than friction can") {
  SlidingPoint point(euler(), {.friction = 3, .ground_speed = 1});
  for (int i = 1; i <= 60; ++i) {
    point.step();
    CHECK(point.speed() == doctest::Approx(std::min(1.0, 3 * h * i)).epsilon(1e-12));
  }
}

TEST_CASE("BDF2 is of second order on a slope, but for its first step") {
  SlidingPoint point({.integrator = pliant::Integrator::bdf2}, {.pull = 5, .friction = 3});
  for (int i = 0; i < 60; ++i) point.step();
  CHECK(point.way() == doctest::Approx(1).epsilon(1e-3));
  CHECK(point.speed() == doctest::Approx(2).epsilon(1e-12));
}

}  // namespace test_sliding_point
