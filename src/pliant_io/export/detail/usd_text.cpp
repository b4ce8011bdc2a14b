#include "pliant_io/export/detail/usd_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace pliant {

void UsdText::line(std::string_view text) {
  constexpr std::size_t block = 1 << 20;
  buffer_.append(4 * depth_, ' ');
  buffer_ += text;
  buffer_ += '\n';
  if (buffer_.size() >= block) flush();
}

void UsdText::open(std::string_view head, std::string_view bracket) {
  line(head);
  line(bracket);
  ++depth_;
}

void UsdText::close(std::string_view bracket) {
  --depth_;
  line(bracket);
}

void UsdText::flush() {
  file_.write(buffer_);
  buffer_.clear();
}

std::string usd_string(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
  }
  // JSON and USD quote alike but for control characters.
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string PrimNames::name(std::string_view text) {
  std::string name;
  for (const char c : text) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    const bool is_digit = c >= '0' && c <= '9';
    if (is_digit && name.empty()) name += '_';
    name += is_letter || is_digit ? c : '_';
  }
  if (name.empty()) name = "_";
  std::string result = name;
  for (int i = 1; !used_.insert(result).second; ++i) result = fmt::format("{}_{}", name, i);
  return result;
}

}  // namespace pliant
