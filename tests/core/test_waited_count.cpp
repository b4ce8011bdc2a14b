#include <atomic>
#include <chrono>
#include <thread>

#include <doctest/doctest.h>

#include "pliant/core/thread_pool.h"
#include "pliant/core/waited_count.h"

namespace test_waited_count {

using namespace pliant;
using namespace std::chrono_literals;

TEST_CASE("two threads that wait for each other meet every time, whether they look or sleep") {
  for (const WaitedCount::Patience patience : {0ns, 200ns, 50'000ns}) {
    constexpr std::uint32_t rounds = 5000;
    WaitedCount there;
    WaitedCount back;
    std::thread other([&] {
      for (std::uint32_t round = 0; round < rounds; ++round) {
        REQUIRE(there.wait_while(round, patience) == round + 1);
        back.value.fetch_add(1);
        back.wake();
      }
    });
    for (std::uint32_t round = 0; round < rounds; ++round) {
      there.value.fetch_add(1);
      there.wake();
      REQUIRE(back.wait_while(round, patience) == round + 1);
    }
    other.join();
  }
}

TEST_CASE("a count that has changed already is not waited for") {
  WaitedCount count;
  count.value = 3;
  CHECK(count.wait_while(2, 0ns) == 3);
  CHECK(count.wait_while(2, 1ms) == 3);
}

TEST_CASE("threads of a pool that have gone to sleep come to the next loop") {
  ThreadPool pool(2);
  for (int repeat = 0; repeat < 20; ++repeat) {
    std::this_thread::sleep_for(1ms);  // longer than they look for a loop
    // Ends only when two threads are inside at once: each waits for the other.
    std::atomic<int> inside = 0;
    pool.parallel_for(2, [&](Index) {
      ++inside;
      while (inside < 2) std::this_thread::yield();
    });
    CHECK(inside == 2);
  }
}

}  // namespace test_waited_count
