// When steps are due, how fast they come, and the range of colors: all against a clock that the test sets.
#include <doctest/doctest.h>

#include "viewer/auto_range.h"
#include "viewer/frame_statistics.h"

namespace test_pace {

using namespace pliant_viewer;

namespace {

Clock::time_point at(double seconds) {
  return Clock::time_point{} + std::chrono::duration_cast<Clock::duration>(Seconds(1000 + seconds));
}

/// Steps that are taken from 0 s to `end`, each of which takes `cost`.
int count_steps(Pacer& pacer, double h, double cost, double end) {
  int count = 0;
  double now = 0;
  pacer.start(at(0));
  while (now < end) {
    const Seconds wait = pacer.wait(at(now), h);
    if (wait > Seconds(0)) {
      now += std::max(wait.count(), 1e-6);
      continue;
    }
    pacer.took_step();
    ++count;
    now += cost;
  }
  return count;
}

}  // namespace

TEST_CASE("simulated time keeps up with the clock where it can") {
  Pacer pacer;
  CHECK(count_steps(pacer, 1.0 / 60, 0.002, 10) == doctest::Approx(600).epsilon(0.005));
  pacer.set_speed(0.5);
  CHECK(count_steps(pacer, 1.0 / 60, 0.002, 10) == doctest::Approx(300).epsilon(0.01));
  pacer.set_speed(2);
  CHECK(count_steps(pacer, 1, 0.002, 10) == doctest::Approx(20).epsilon(0.1));
}

TEST_CASE("where it cannot, it is never more than four steps behind, and does not make up for a pause") {
  Pacer pacer;
  CHECK(count_steps(pacer, 1.0 / 60, 0.1, 10) == doctest::Approx(100).epsilon(0.02));
  CHECK(pacer.steps_behind() <= Pacer::most_behind);
  CHECK(pacer.steps_behind() > Pacer::most_behind - 1.5);
  // A minute in which nobody asked, as while a mesh is factorized.
  Pacer late;
  late.start(at(0));
  int caught_up = 0;
  while (late.wait(at(60), 1.0 / 60) <= Seconds(0)) {
    late.took_step();
    ++caught_up;
  }
  CHECK(caught_up <= 4);
}

TEST_CASE("without a limit every step is due") {
  Pacer pacer;
  pacer.set_speed(Pacer::unlimited);
  pacer.start(at(0));
  for (int i = 0; i < 1000; ++i) {
    REQUIRE(pacer.wait(at(0), 1.0 / 60) == Seconds(0));
    pacer.took_step();
  }
}

TEST_CASE("statistics cover the last second, and fade when nothing happens") {
  FrameStatistics statistics;
  CHECK(statistics.means(at(0)).rate == 0);
  for (int i = 0; i <= 300; ++i) statistics.add({at(0.01 * i), 0.02, 0.001, 0.002, 0, 0.0005, 0.004});
  const FrameStatistics::Means means = statistics.means(at(3));
  CHECK(means.rate == doctest::Approx(100));
  CHECK(means.speed == doctest::Approx(2));
  CHECK(means.local == doctest::Approx(0.001));
  CHECK(means.contact == doctest::Approx(0.0005));
  CHECK(means.total == doctest::Approx(0.004));
  CHECK(statistics.means(at(103)).rate < 2);
}

TEST_CASE("a range grows at once to a round number, and shrinks only after a while") {
  AutoRange range;
  using pliant::ColorBy;
  CHECK(range.update(ColorBy::speed, 0.7F, at(0))[1] == doctest::Approx(1));
  CHECK(range.update(ColorBy::speed, 3, at(0.1))[1] == doctest::Approx(5));
  CHECK(range.update(ColorBy::speed, 0.3F, at(1))[1] == doctest::Approx(5));
  CHECK(range.update(ColorBy::speed, 0.3F, at(3))[1] == doctest::Approx(0.5));
  CHECK(range.update(ColorBy::stretch, 0.04F, at(3.1))[0] == doctest::Approx(-0.05));
  CHECK(range.update(ColorBy::speed, 0, at(4))[1] > 0);
  CHECK(std::isfinite(range.update(ColorBy::speed, std::numeric_limits<float>::infinity(), at(5))[1]));
}

}  // namespace test_pace
