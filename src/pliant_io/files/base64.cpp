#include "pliant_io/files/base64.h"

#include <cstdint>

namespace pliant {
namespace {

constexpr std::string_view base64_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

std::string base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      group = group << 8U | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0U);
    }
    for (std::size_t j = 0; j < 4; ++j) text += i + j > bytes.size() ? '=' : base64_digits[group >> (18 - 6 * j) & 63U];
  }
  return text;
}

std::optional<std::string> bytes_of_base64(std::string_view text) {
  if (text.size() % 4 != 0) return {};
  const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  for (std::size_t i = 0; i < text.size(); i += 4) {
    std::uint32_t group = 0;
    for (std::size_t j = i; j < i + 4; ++j) {
      const bool is_padding = j + padding >= text.size();
      const std::size_t digit = is_padding ? 0 : base64_digits.find(text[j]);
      if (digit == std::string_view::npos) return {};
      group = group << 6U | static_cast<std::uint32_t>(digit);
    }
    for (unsigned shift = 16; i + 4 < text.size() || shift / 8 >= padding; shift -= 8) {
      bytes += static_cast<char>(group >> shift & 255U);
      if (shift == 0) break;
    }
  }
  return bytes;
}

}  // namespace pliant
