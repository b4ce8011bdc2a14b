#include "pliant_io/checkpoint/detail/write_values.h"

namespace pliant {

using Json = nlohmann::json;

namespace {

Json binary(const void* data, std::size_t size) {
  const auto* begin = static_cast<const std::uint8_t*>(data);
  return Json::binary(std::vector<std::uint8_t>(begin, begin + size));
}

}  // namespace

Json bytes_of(std::string_view text) {
  return binary(text.data(), text.size());
}

Json bytes_of(std::span<const Real> numbers) {
  return binary(numbers.data(), numbers.size_bytes());
}

Json bytes_of(const Positions& rows) {
  return bytes_of(std::span<const Real>(rows.data(), static_cast<std::size_t>(rows.size())));
}

Json bytes_of(const Vec3& vector) {
  return bytes_of(std::span<const Real>(vector.data(), 3));
}

}  // namespace pliant
