#pragma once
// Numbers from text and to text, the same for every locale, also where the standard library has std::from_chars and
// std::to_chars for integers alone (libc++).
#include <array>
#include <charconv>

#include "pliant/core/types.h"

namespace pliant {

/// std::from_chars in its general format. With a standard library that lacks it, strtod as in the C locale gives the
/// same bits: both give the double nearest to the text.
std::from_chars_result number_from_chars(const char* begin, const char* end, Real& number);

/// Room for any number.
using NumberText = std::array<char, 32>;

/// Writes the shortest digits that read back to the same number. @returns their end
char* number_to_chars(NumberText& text, Real number);

namespace detail {

/// What number_from_chars does without std::from_chars.
std::from_chars_result number_from_chars_by_strtod(const char* begin, const char* end, Real& number);
/// What number_to_chars does without std::to_chars; the digits are the same, the notation need not be.
char* number_to_chars_by_fmt(NumberText& text, Real number);

}  // namespace detail

}  // namespace pliant
