#include <atomic>
#include <stdexcept>

#include <doctest/doctest.h>

#include "../mesh/meshes.h"
#include "pliant/core/thread_pool.h"

namespace test_thread_pool {

using namespace pliant;
using namespace pliant_tests;

TEST_CASE("a thread pool calls the body once for every iteration, whatever the counts") {
  for (const int threads : {1, 2, 3, 8}) {
    ThreadPool pool(threads);
    CHECK(pool.thread_count() == threads);
    for (const Index count : {0, 1, 2, 7, 1000}) {
      for (int repeat = 0; repeat < 20; ++repeat) {
        std::vector<std::atomic<int>> calls(static_cast<std::size_t>(count));
        pool.parallel_for(count, [&](Index i) { ++calls[static_cast<std::size_t>(i)]; });
        for (const auto& times : calls) REQUIRE(times == 1);
      }
    }
  }
}

TEST_CASE("a thread pool passes an exception on and works afterwards") {
  for (const int threads : {1, 4}) {
    ThreadPool pool(threads);
    const auto fail = [](Index i) {
      if (i == 13) throw std::runtime_error("13");
    };
    CHECK_THROWS_WITH(pool.parallel_for(100, fail), "13");
    std::atomic<Index> sum = 0;
    pool.parallel_for(100, [&](Index i) { sum += i; });
    CHECK(sum == 4950);
  }
}

TEST_CASE("a negative number of threads is refused, zero means all processors") {
  CHECK(contains(error_of([] { ThreadPool(-1); }), "threads: -1 is negative"));
  CHECK(ThreadPool(0).thread_count() >= 1);
}

}  // namespace test_thread_pool
