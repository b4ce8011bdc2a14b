#include "bench/bandwidth.h"

#include <algorithm>
#include <limits>

#include "pliant/core/stopwatch.h"
#include "system/machine.h"
#include "system/memory.h"

namespace pliant_bench {
namespace {

constexpr std::int64_t mebibyte = 1 << 20;
// Where the system does not tell: what most processors of today have at least.
constexpr std::int64_t usual_l2 = mebibyte / 2;
constexpr std::int64_t usual_l3 = 8 * mebibyte;
constexpr std::int64_t largest_buffer = 2048 * mebibyte;
constexpr std::int64_t memory_times_cache = 3;

using Lanes = double __attribute__((vector_size(32)));
constexpr std::size_t numbers_at_once = 32;

/// Sums in eight registers: enough additions under way that they are not what is waited for.
__attribute__((always_inline)) inline double sum_of(const double* numbers, std::size_t count) {
  Lanes sums[8] = {};
  for (std::size_t i = 0; i + numbers_at_once <= count; i += numbers_at_once) {
    for (std::size_t lane = 0; lane < 8; ++lane) {
      sums[lane] += *reinterpret_cast<const Lanes*>(numbers + i + 4 * lane);
    }
  }
  double total = 0;
  for (const Lanes& sum : sums) total += sum[0] + sum[1] + sum[2] + sum[3];
  return total;
}

double sum_portable(const double* numbers, std::size_t count) {
  return sum_of(numbers, count);
}

#ifdef __x86_64__
__attribute__((target("avx2"))) double sum_avx2(const double* numbers, std::size_t count) {
  return sum_of(numbers, count);
}
using Sum = double (*)(const double*, std::size_t);
Sum sum_for_this_processor() {
  return __builtin_cpu_supports("avx2") ? sum_avx2 : sum_portable;
}
#else
using Sum = double (*)(const double*, std::size_t);
Sum sum_for_this_processor() {
  return sum_portable;
}
#endif

/// The fastest of passes over a buffer.
double read_speed(std::int64_t bytes) {
  ReadProbe probe(bytes);
  double best = std::numeric_limits<double>::infinity();
  const pliant::Stopwatch whole;
  for (int sample = 0; sample < 2 || (whole.seconds() < 0.15 && sample < 200); ++sample) {
    best = std::min(best, probe.seconds());
  }
  return static_cast<double>(probe.bytes()) / best;
}

}  // namespace

ReadProbe::ReadProbe(std::int64_t bytes)
    : count_(std::max<std::size_t>(1, static_cast<std::size_t>(bytes) / sizeof(double) / numbers_at_once) *
             numbers_at_once),
      buffer_(count_ + 4, 1.0) {
  const auto address = reinterpret_cast<std::uintptr_t>(buffer_.data());
  aligned_ = buffer_.data() + (32 - address % 32) % 32 / sizeof(double);
}

double ReadProbe::seconds() {
  const Sum sum = sum_for_this_processor();
  volatile double sink = sum(aligned_, count_);
  constexpr std::int64_t bytes_a_sample = 8 * mebibyte;  // long enough for the clock
  const std::int64_t passes = std::max<std::int64_t>(1, bytes_a_sample / bytes());
  const pliant::Stopwatch watch;
  for (std::int64_t pass = 0; pass < passes; ++pass) sink = sink + sum(aligned_, count_);
  return watch.seconds() / static_cast<double>(passes);
}

std::vector<Level> measure_levels() {
  const std::int64_t l2 = pliant_system::cache_bytes(2) > 0 ? pliant_system::cache_bytes(2) : usual_l2;
  const std::int64_t l3 = std::max(l2, pliant_system::cache_bytes(3) > 0 ? pliant_system::cache_bytes(3) : usual_l3);
  std::vector<Level> levels;
  levels.push_back({"L2", l2, l2 / 2, read_speed(l2 / 2)});
  levels.push_back({"L3", l3, l3 / 2, read_speed(l3 / 2)});
  const std::int64_t wanted = memory_times_cache * l3;
  if (wanted <= largest_buffer && wanted <= pliant_system::free_memory_bytes() / 3) {
    levels.push_back({"memory", 0, wanted, read_speed(wanted)});
  }
  return levels;
}

}  // namespace pliant_bench
