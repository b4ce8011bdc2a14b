#include "report/text.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "pliant/core/printable.h"

namespace pliant_report {
namespace {

constexpr double text_size = 13;

/// Without control characters, and UTF-8 throughout.
std::string cleaned(std::string_view text) {
  std::string result = pliant::printable(text, std::string_view::npos);
  // U+FFFE and U+FFFF are UTF-8, yet no characters of XML (XML 1.0, Sec. 2.2).
  for (const std::string_view alien : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"}) {
    for (std::size_t at = result.find(alien); at != std::string::npos; at = result.find(alien, at)) {
      result.replace(at, alien.size(), 1, '?');
    }
  }
  return result;
}

/// The first character of a text that is UTF-8.
std::string_view first_character(std::string_view text) {
  std::size_t size = 1;
  while (size < text.size() && (static_cast<unsigned char>(text[size]) & 0xC0U) == 0x80U) ++size;
  return text.substr(0, size);
}

bool is_one_of(std::string_view character, std::string_view set) {
  return set.find(character) != std::string_view::npos;
}

/// In sizes of the text.
double character_width(std::string_view character) {
  const auto lead = static_cast<unsigned char>(character.front());
  if (is_one_of(character, "ijl|!'.,:;")) return 0.31;
  if (is_one_of(character, " ftrI()[]{}-/\\\"*`")) return 0.41;
  if (is_one_of(character, "mwMWQO@%&+<>=~")) return 0.9;
  if (is_one_of(character, "⁰¹²³⁴⁵⁶⁷⁸⁹⁻·")) return 0.42;
  if (lead < 0x80U) return lead >= 'A' && lead <= 'Z' ? 0.71 : 0.61;
  if (lead == 0xCCU) return 0;  // marks over the letter before
  if (lead < 0xE0U) return 0.67;
  return lead >= 0xE3U ? 1.05 : 0.85;  // signs; and from there on mostly characters as wide as they are high
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : cleaned(text)) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

double text_width(std::string_view text, bool is_bold) {
  double width = 0;
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view character = first_character(rest);
    width += character_width(character);
    rest.remove_prefix(character.size());
  }
  return width * text_size * (is_bold ? 1.08 : 1);
}

std::vector<std::string> wrapped(std::string_view text, double width, bool is_bold) {
  const std::string clean = cleaned(text);
  std::vector<std::string> lines(1);
  std::string word;
  const auto put = [&] {
    const std::string longer = lines.back().empty() ? word : fmt::format("{} {}", lines.back(), word);
    if (lines.back().empty() || text_width(longer, is_bold) <= width) {
      lines.back() = longer;
    } else {
      lines.push_back(word);
    }
    word.clear();
  };
  for (std::string_view rest = clean; !rest.empty();) {
    const std::string_view character = first_character(rest);
    rest.remove_prefix(character.size());
    if (character == " ") {
      if (!word.empty()) put();
      continue;
    }
    if (!word.empty() && text_width(fmt::format("{}{}", word, character), is_bold) > width) put();
    word += character;
  }
  if (!word.empty()) put();
  return lines;
}

std::string shortened(std::string_view text, double width) {
  const std::string clean = cleaned(text);
  if (text_width(clean) <= width) return clean;
  std::string result;
  double used = text_width("…");
  for (std::string_view rest = clean; !rest.empty();) {
    const std::string_view character = first_character(rest);
    used += text_width(character);
    if (used > width) break;
    result += character;
    rest.remove_prefix(character.size());
  }
  return result + "…";
}

}  // namespace pliant_report
