#include "pliant_io/checkpoint/detail/read_values.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pliant {

std::string read_bytes(const Node& node) {
  if (!node.is_bytes()) node.fail_type("a string of bytes");
  return std::string(node.bytes());
}

void read_numbers(const Node& node, std::span<Real> numbers) {
  if (!node.is_bytes() || node.bytes().size() != numbers.size_bytes()) {
    node.fail(
        fmt::format("{} numbers belong here, as the scene or the simulation is now; make it as it was, or resume "
                    "it with the version that wrote it",
                    numbers.size()));
  }
  if (!numbers.empty()) std::memcpy(numbers.data(), node.bytes().data(), numbers.size_bytes());
  if (std::ranges::all_of(numbers, [](Real x) { return std::isfinite(x); })) return;
  node.fail("a number is not finite; take another checkpoint");
}

Real read_real(const Node& node) {
  Real number = 0;
  read(node, number);
  return number;
}

void read_rotation(const Node& node, Quaternion& rotation) {
  read_numbers(node, {rotation.coeffs().data(), 4});
}

}  // namespace pliant
