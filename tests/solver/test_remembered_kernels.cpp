// Products and sums of remembered vectors, for every instruction set at hand: to the last bit what the same operations
// give one after the other.
#include <array>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "../core/random.h"
#include "pliant/solver/acceleration/remembered_kernels.h"

namespace test_remembered_kernels {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr std::array<std::size_t, 12> counts = {0, 1, 2, 3, 7, 8, 9, 15, 16, 27, 64, 1536};

template <class T>
std::vector<T> random_numbers(Random& random, std::size_t count) {
  std::vector<T> numbers(count);
  for (T& each : numbers) each = static_cast<T>(random.uniform(-1, 1));
  numbers.shrink_to_fit();
  return numbers;
}

struct Remembered {
  std::vector<std::vector<float>> vectors;
  std::vector<const float*> begins;

  Remembered(Random& random, std::size_t many, std::size_t count) {
    for (std::size_t i = 0; i < many; ++i) vectors.push_back(random_numbers<float>(random, count));
    for (const auto& each : vectors) begins.push_back(each.data());
  }
};

template <class T>
Real in_eight_sums(const std::vector<T>& a, const std::vector<Real>& c) {
  std::array<Real, 8> sums = {};
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Real product = static_cast<Real>(a[i]) * c[i];
    sums[i % 8] += product;
  }
  Real sum = 0;
  for (const Real each : sums) sum += each;
  return sum;
}

}  // namespace

TEST_CASE("products with remembered vectors have the same bits on every instruction set") {
  for (const RememberedKernels* kernels : remembered_kernels()) {
    CAPTURE(std::string(kernels->instruction_set));
    Random random;
    for (const std::size_t count : counts) {
      CAPTURE(count);
      for (std::size_t many = 0; many <= 11; ++many) {
        CAPTURE(many);
        const Remembered remembered(random, many, count);
        const auto& [vectors, begins] = remembered;
        const std::vector<Real> c = random_numbers<Real>(random, count);
        std::vector<Real> found(many + 1, 7);
        kernels->products(begins.data(), many, c.data(), count, found.data());
        for (std::size_t i = 0; i < many; ++i) CHECK(found[i] == in_eight_sums(vectors[i], c));
        CHECK(found[many] == 7);
      }
      const std::vector<Real> a = random_numbers<Real>(random, count), c = random_numbers<Real>(random, count);
      CHECK(kernels->product(a.data(), c.data(), count) == in_eight_sums(a, c));
    }
  }
}

TEST_CASE("a move along remembered vectors has the same bits on every instruction set") {
  for (const RememberedKernels* kernels : remembered_kernels()) {
    CAPTURE(std::string(kernels->instruction_set));
    Random random;
    for (const std::size_t count : counts) {
      CAPTURE(count);
      for (std::size_t pairs = 0; pairs <= 3; ++pairs) {
        CAPTURE(pairs);
        const Remembered remembered(random, 2 * pairs, count);
        const auto& [vectors, begins] = remembered;
        const std::vector<Real> factors = random_numbers<Real>(random, 2 * pairs);
        const std::vector<Real> x = random_numbers<Real>(random, count), q = random_numbers<Real>(random, count);
        std::vector<Real> moved = q, before(count);
        std::vector<float> move(count);
        kernels->move({.factor = 0.7,
                       .x = x.data(),
                       .vectors = begins.data(),
                       .factors = factors.data(),
                       .pairs = pairs,
                       .q = moved.data(),
                       .before = before.data(),
                       .move = move.data()},
                      count);
        for (std::size_t i = 0; i < count; ++i) {
          Real sum = 0.7 * x[i];
          for (std::size_t k = 0; k < pairs; ++k) {
            const Real first = factors[2 * k] * static_cast<Real>(vectors[2 * k][i]);
            const Real second = factors[2 * k + 1] * static_cast<Real>(vectors[2 * k + 1][i]);
            const Real both = first + second;
            sum += both;
          }
          const bool is_right = moved[i] == q[i] + sum && before[i] == q[i] && move[i] == static_cast<float>(sum);
          CHECK(is_right);
        }
      }
    }
  }
}

}  // namespace test_remembered_kernels
