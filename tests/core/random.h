#pragma once
// Random numbers that are the same on every machine.
#include <cmath>
#include <numbers>
#include <random>

#include "pliant/core/types.h"

namespace pliant_tests {

class Random {
 public:
  explicit Random(std::uint64_t seed = 1) : engine_(seed) {}

  pliant::Real uniform(pliant::Real min, pliant::Real max) {
    return min + (max - min) * static_cast<pliant::Real>(engine_() >> 11) * 0x1p-53;
  }
  pliant::Index index(pliant::Index count) {
    return static_cast<pliant::Index>(engine_() % static_cast<std::uint64_t>(count));
  }
  /// Coordinates between −size and size.
  pliant::Vec3 vector(pliant::Real size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
  pliant::Vec3 unit_vector() {
    const pliant::Real z = uniform(-1, 1);
    const pliant::Real angle = uniform(0, 2 * std::numbers::pi);
    const pliant::Real r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }
  pliant::Mat3 rotation() {
    return Eigen::AngleAxis<pliant::Real>(uniform(0, 2 * std::numbers::pi), unit_vector()).toRotationMatrix();
  }
  pliant::Positions positions(Eigen::Index count, pliant::Real size) {
    pliant::Positions x(count, 3);
    for (pliant::Index i = 0; i < count; ++i) x.row(i) = vector(size).transpose();
    return x;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace pliant_tests
