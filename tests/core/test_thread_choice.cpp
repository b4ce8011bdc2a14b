#include <functional>
#include <random>

#include <doctest/doctest.h>

#include "pliant/core/thread_choice.h"

namespace test_thread_choice {

using namespace pliant;

namespace {

/// Pieces of work whose time is a function of the number of threads, with noise of a few percent.
class Work {
 public:
  explicit Work(std::function<double(int)> seconds) : seconds_(std::move(seconds)) {}

  /// The time of so many pieces [s].
  double run(ThreadChoice& choice, int pieces) {
    double sum = 0;
    for (int i = 0; i < pieces; ++i) {
      const double time = seconds_(choice.threads()) * noise_(random_);
      choice.took(time);
      sum += time;
    }
    return sum;
  }

 private:
  std::function<double(int)> seconds_;
  std::mt19937 random_{7};
  std::uniform_real_distribution<double> noise_{0.98, 1.05};
};

}  // namespace

TEST_CASE("as many threads as pay are found within a few steps") {
  ThreadChoice choice(8);
  CHECK(choice.threads() == 1);
  Work work([](int threads) { return 1e-3 / threads; });
  const double time = work.run(choice, 600);
  CHECK(choice.threads() == 8);
  CHECK(time < 1.2 * 600 * 1e-3 / 8);
}

TEST_CASE("where more threads lose, one is kept and trials cost little") {
  ThreadChoice choice(2);
  Work work([](int threads) { return threads == 1 ? 1e-3 : 4e-3; });
  const double time = work.run(choice, 600);
  CHECK(choice.threads() == 1);
  CHECK(time < 1.08 * 600 * 1e-3);
}

TEST_CASE("the best number lies in between, and is no power of two") {
  ThreadChoice choice(6);
  Work work([](int threads) { return threads == 6 ? 1e-3 : 2e-3 / threads + 1e-3; });
  work.run(choice, 200);
  CHECK(choice.threads() == 6);
}

TEST_CASE("another program comes and goes") {
  ThreadChoice choice(2);
  bool is_busy = false;
  Work work([&is_busy](int threads) { return threads == 1 ? 1e-3 : is_busy ? 4e-3 : 0.6e-3; });
  work.run(choice, 400);
  CHECK(choice.threads() == 2);
  is_busy = true;
  const double busy = work.run(choice, 400);
  CHECK(choice.threads() == 1);
  CHECK(busy < 1.25 * 400 * 1e-3);
  is_busy = false;
  work.run(choice, 2000);
  CHECK(choice.threads() == 2);
}

TEST_CASE("one thread needs no clock, and another work begins anew") {
  ThreadChoice one(1);
  one.took(1);
  CHECK(one.threads() == 1);

  ThreadChoice choice(2);
  Work fast([](int threads) { return 1e-3 / threads; });
  fast.run(choice, 100);
  CHECK(choice.threads() == 2);
  choice.restart();
  Work slow([](int threads) { return 1e-2 * threads; });
  slow.run(choice, 100);
  CHECK(choice.threads() == 1);
}

}  // namespace test_thread_choice
