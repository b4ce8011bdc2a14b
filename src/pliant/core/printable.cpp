#include "pliant/core/printable.h"

#include <algorithm>
#include <cstdint>

namespace pliant {
namespace {

/// One character of UTF-8; size 0: the bytes are none.
struct Character {
  std::size_t size = 0;
  std::uint32_t code = 0;
};

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80U) return {1, lead};
  const std::size_t size = lead >= 0xF0U ? 4 : lead >= 0xE0U ? 3 : 2;
  if (lead < 0xC2U || lead > 0xF4U || text.size() < size) return {};
  std::uint32_t code = lead & (0xFFU >> (size + 1));
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    code = code << 6U | (byte(i) & 0x3FU);
  }
  const bool overlong = (size == 3 && code < 0x800U) || (size == 4 && code < 0x10000U);
  if (overlong || code > 0x10FFFFU || (code >= 0xD800U && code <= 0xDFFFU)) return {};
  return {size, code};
}

bool is_control(std::uint32_t code) {
  return code < 0x20U || (code >= 0x7FU && code < 0xA0U) || code == 0x061CU || (code >= 0x200EU && code <= 0x200FU) ||
         (code >= 0x2028U && code <= 0x202EU) || (code >= 0x2066U && code <= 0x2069U) || code == 0xFEFFU;
}

}  // namespace

std::string printable(std::string_view text, std::size_t limit) {
  std::string result;
  result.reserve(std::min(text.size(), limit) + 3);
  while (!text.empty()) {
    const Character character = first_character(text);
    const std::size_t size = std::max<std::size_t>(character.size, 1);
    if (result.size() + size > limit) return result + "...";
    if (character.size == 0) {
      result += '?';
    } else if (is_control(character.code)) {
      result += ' ';
    } else {
      result += text.substr(0, size);
    }
    text.remove_prefix(size);
  }
  return result;
}

std::string printable_place(std::string_view text, std::size_t limit) {
  const std::size_t start = limit * 3 / 8;
  if (text.size() <= limit) return printable(text, limit);
  std::string_view end = text.substr(text.size() - (limit - start));
  const auto is_inside_character = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  while (!end.empty() && is_inside_character(end.front())) end.remove_prefix(1);
  return printable(text, start) + printable(end, limit);
}

}  // namespace pliant
