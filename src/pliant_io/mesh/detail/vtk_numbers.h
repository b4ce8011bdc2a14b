#pragma once
// Numbers as VTK's files hold them: integers and floats of any width, in either order of bytes.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>

#include "pliant/core/types.h"

namespace pliant {

enum class VtkType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };
enum class VtkByteOrder { little, big };

/// By its name in an XML file ("Float64"); nothing for any other name.
std::optional<VtkType> xml_type(std::string_view name);
/// By its name in a legacy file ("unsigned_char"), in small letters.
std::optional<VtkType> legacy_type(std::string_view name);

std::size_t byte_count(VtkType type);
inline bool is_float(VtkType type) {
  return type == VtkType::float32 || type == VtkType::float64;
}

template <class Number>
Number take_vtk_number(const char* bytes, VtkByteOrder order) {
  std::array<char, sizeof(Number)> copy;
  std::memcpy(copy.data(), bytes, copy.size());
  if (order == VtkByteOrder::big) std::ranges::reverse(copy);
  return std::bit_cast<Number>(copy);
}

/// Calls `use` with the number that stands there, as it is.
template <class Use>
auto with_vtk_number(VtkType type, const char* bytes, VtkByteOrder order, const Use& use) {
  switch (type) {
    case VtkType::int8:
      return use(take_vtk_number<std::int8_t>(bytes, order));
    case VtkType::uint8:
      return use(take_vtk_number<std::uint8_t>(bytes, order));
    case VtkType::int16:
      return use(take_vtk_number<std::int16_t>(bytes, order));
    case VtkType::uint16:
      return use(take_vtk_number<std::uint16_t>(bytes, order));
    case VtkType::int32:
      return use(take_vtk_number<std::int32_t>(bytes, order));
    case VtkType::uint32:
      return use(take_vtk_number<std::uint32_t>(bytes, order));
    case VtkType::int64:
      return use(take_vtk_number<std::int64_t>(bytes, order));
    case VtkType::uint64:
      return use(take_vtk_number<std::uint64_t>(bytes, order));
    case VtkType::float32:
      return use(take_vtk_number<float>(bytes, order));
    case VtkType::float64:
      break;
  }
  return use(take_vtk_number<double>(bytes, order));
}

inline Real vtk_real(VtkType type, const char* bytes, VtkByteOrder order) {
  return with_vtk_number(type, bytes, order, [](auto number) { return static_cast<Real>(number); });
}

/// Of a type that is not a float. What is larger than any index is the largest number there is.
inline std::int64_t vtk_integer(VtkType type, const char* bytes, VtkByteOrder order) {
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  return with_vtk_number(type, bytes, order, [](auto number) {
    if constexpr (std::is_same_v<decltype(number), std::uint64_t>) {
      return number > static_cast<std::uint64_t>(most) ? most : static_cast<std::int64_t>(number);
    } else {
      return static_cast<std::int64_t>(number);
    }
  });
}

}  // namespace pliant
