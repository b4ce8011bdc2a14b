#include "viewer/rounding.h"

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "pliant_io/files/number_text.h"

namespace pliant_viewer {
namespace {

using pliant::Real;

Real number_of(const std::string& text) {
  Real number = 0;
  pliant::number_from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// To a power of ten, by text: the double that is nearest to the decimal number.
Real rounded_to(Real number, int power) {
  const Real scale = std::abs(number);
  const int first = scale > 0 ? static_cast<int>(std::floor(std::log10(scale))) : power;
  if (first < power) {
    const Real least = number_of(fmt::format("1e{}", power));
    return scale < least / 2 ? 0 : std::copysign(least, number);
  }
  return number_of(fmt::format("{:.{}e}", number, first - power));
}

}  // namespace

Real with_digits(Real number, int digits) {
  if (number == 0 || !std::isfinite(number)) return number;
  return number_of(fmt::format("{:.{}e}", number, digits - 1));
}

pliant::Vec3 with_digits(const pliant::Vec3& vector, int digits) {
  const Real largest = vector.cwiseAbs().maxCoeff();
  if (!(largest > 0) || !vector.allFinite()) return vector;
  const int power = static_cast<int>(std::floor(std::log10(largest))) - digits + 1;
  return vector.unaryExpr([power](Real number) { return rounded_to(number, power); });
}

Real without_single_precision(Real number) {
  const auto single = static_cast<float>(number);
  if (!std::isfinite(single) || static_cast<Real>(single) != number) return number;
  return number_of(fmt::format("{}", single));
}

pliant::Vec3 without_single_precision(const pliant::Vec3& vector) {
  return vector.unaryExpr([](Real number) { return without_single_precision(number); });
}

}  // namespace pliant_viewer
