#include "report/typeset.h"

#include <array>
#include <cctype>

#include <fmt/format.h>

namespace pliant_report {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Whether a number cannot begin, or end, beside this character: it is part of a name.
bool is_of_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' ||
         (static_cast<unsigned char>(c) & 0x80U) != 0;
}

std::size_t end_of_digits(std::string_view text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

std::string superscript(std::string_view exponent, bool is_negative) {
  constexpr std::array<std::string_view, 10> digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  while (exponent.size() > 1 && exponent.front() == '0') exponent.remove_prefix(1);
  std::string result = is_negative ? "⁻" : "";
  for (const char digit : exponent) result += digits[static_cast<std::size_t>(digit - '0')];
  return result;
}

/// A number with an exponent at the start of a text: how long it is, and how it is printed.
struct Number {
  std::size_t size = 0;  // 0: there is none
  std::string printed{};
};

Number number_at(std::string_view text) {
  std::size_t end = end_of_digits(text, 0);
  if (end == 0) return {};
  if (end + 1 < text.size() && text[end] == '.' && is_digit(text[end + 1])) end = end_of_digits(text, end + 1);
  const std::string_view mantissa = text.substr(0, end);
  if (end >= text.size() || text[end] != 'e') return {};
  std::size_t first = end + 1;
  const bool is_negative = first < text.size() && text[first] == '-';
  if (first < text.size() && (text[first] == '-' || text[first] == '+')) ++first;
  const std::size_t last = end_of_digits(text, first);
  if (last == first) return {};
  const bool is_in_name = last < text.size() && is_of_name(text[last]) &&
                          (text[last] != '.' || (last + 1 < text.size() && is_digit(text[last + 1])));
  if (is_in_name) return {};
  const std::string power = fmt::format("10{}", superscript(text.substr(first, last - first), is_negative));
  return {last, mantissa == "1" ? power : fmt::format("{}·{}", mantissa, power)};
}

void set(std::string& text) {
  text = with_powers(text);
}

struct BlockSetter {
  void operator()(Paragraph& paragraph) const { set(paragraph.text); }
  void operator()(Plot& plot) const { plot = with_powers(std::move(plot)); }
  void operator()(Picture& picture) const { set(picture.caption); }
  void operator()(Table& table) const {
    set(table.caption);
    for (std::string& column : table.columns) set(column);
    for (std::vector<std::string>& row : table.rows) {
      for (std::string& cell : row) set(cell);
    }
  }
};

}  // namespace

std::string with_powers(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const bool may_begin = at == 0 || !is_of_name(text[at - 1]);
    const Number number = may_begin ? number_at(text.substr(at)) : Number{};
    if (number.size > 0) {
      result += number.printed;
      at += number.size;
    } else {
      result += text[at++];
    }
  }
  return result;
}

Plot with_powers(Plot plot) {
  for (std::string* text : {&plot.title, &plot.caption, &plot.x.label, &plot.y.label}) set(*text);
  for (Series& series : plot.series) set(series.name);
  for (Guide& guide : plot.guides) set(guide.label);
  return plot;
}

Report with_powers(Report report) {
  set(report.introduction);
  for (Chapter& chapter : report.chapters) {
    for (std::string* text : {&chapter.title, &chapter.question}) set(*text);
    for (Claim& claim : chapter.claims) {
      for (std::string* text : {&claim.text, &claim.evidence}) set(*text);
    }
    for (Block& block : chapter.blocks) std::visit(BlockSetter{}, block);
  }
  return report;
}

}  // namespace pliant_report
