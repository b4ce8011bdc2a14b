#include "pliant_io/files/number_text.h"

#include <algorithm>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>
#include <version>

#include <fmt/format.h>

namespace pliant {

namespace {

std::size_t digits_at(std::string_view text, std::size_t begin) {
  return std::min(text.find_first_not_of("0123456789", begin), text.size()) - begin;
}

/// The length of the decimal number that a text begins with, as std::from_chars understands it; 0 if there is none.
/// strtod by itself takes more: blanks, a plus sign, hexadecimal numbers.
std::size_t decimal_length(std::string_view text) {
  std::size_t place = text.starts_with('-') ? 1 : 0;
  const std::size_t whole = digits_at(text, place);
  place += whole;
  std::size_t fraction = 0;
  if (text.substr(place).starts_with('.')) {
    fraction = digits_at(text, place + 1);
    place += 1 + fraction;
  }
  if (whole + fraction == 0) return 0;
  if (text.size() > place && (text[place] == 'e' || text[place] == 'E')) {
    const bool has_sign = text.size() > place + 1 && (text[place + 1] == '-' || text[place + 1] == '+');
    const std::size_t digits_begin = place + (has_sign ? 2 : 1);
    const std::size_t digits = digits_begin < text.size() ? digits_at(text, digits_begin) : 0;
    if (digits > 0) place = digits_begin + digits;
  }
  return place;
}

/// The length of "inf", "infinity", "nan" or "nan(...)" in any letters, with or without a minus sign; else 0.
std::size_t name_length(std::string_view text) {
  const std::size_t sign = text.starts_with('-') ? 1 : 0;
  std::string small(text.substr(sign, std::string_view("infinity").size()));
  for (char& c : small) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (small == "infinity") return sign + small.size();
  if (small.starts_with("inf")) return sign + 3;
  if (!small.starts_with("nan")) return 0;
  constexpr std::string_view letters = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ_abcdefghijklmnopqrstuvwxyz";
  const std::size_t after = sign + 3;
  if (text.size() == after || text[after] != '(') return after;
  const std::size_t close = text.find_first_not_of(letters, after + 1);
  return close != text.npos && text[close] == ')' ? close + 1 : after;
}

/// strtod as it is in the C locale: what a program has set may have another sign than a point.
Real strtod_with_points(std::string word) {
  const std::size_t point = word.find('.');
  if (point != word.npos) word.replace(point, 1, std::localeconv()->decimal_point);
  return std::strtod(word.c_str(), nullptr);
}

}  // namespace

namespace detail {

std::from_chars_result number_from_chars_by_strtod(const char* begin, const char* end, Real& number) {
  const std::string_view text(begin, static_cast<std::size_t>(end - begin));
  const std::size_t digits = decimal_length(text);
  const std::size_t length = digits > 0 ? digits : name_length(text);
  if (length == 0) return {begin, std::errc::invalid_argument};
  const std::string word(text.substr(0, length));  // strtod wants a zero behind it
  const Real value = strtod_with_points(word);
  const std::string_view factor = std::string_view(word).substr(0, word.find_first_of("eE"));
  const bool is_too_small = value == 0 && digits > 0 && factor.find_first_of("123456789") != factor.npos;
  const bool is_too_large = std::isinf(value) && digits > 0;
  if (is_too_small || is_too_large) return {begin + length, std::errc::result_out_of_range};
  number = value;
  return {begin + length, std::errc()};
}

char* number_to_chars_by_fmt(NumberText& text, Real number) {
  return fmt::format_to_n(text.data(), text.size(), "{}", number).out;
}

}  // namespace detail

std::from_chars_result number_from_chars(const char* begin, const char* end, Real& number) {
#ifdef __cpp_lib_to_chars
  return std::from_chars(begin, end, number);
#else
  return detail::number_from_chars_by_strtod(begin, end, number);
#endif
}

char* number_to_chars(NumberText& text, Real number) {
#ifdef __cpp_lib_to_chars
  return std::to_chars(text.data(), text.data() + text.size(), number).ptr;
#else
  return detail::number_to_chars_by_fmt(text, number);
#endif
}

}  // namespace pliant
