#include <bit>
#include <clocale>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <system_error>

#include <doctest/doctest.h>

#include "pliant_io/files/number_text.h"

namespace test_number_text {

using namespace pliant;

using Reader = std::from_chars_result (*)(const char*, const char*, Real&);
using Writer = char* (*)(NumberText&, Real);

constexpr Reader readers[] = {number_from_chars, detail::number_from_chars_by_strtod};
constexpr Writer writers[] = {number_to_chars, detail::number_to_chars_by_fmt};

constexpr Real untouched = 77;

struct Read {
  Real number = untouched;
  std::size_t length = 0;
  std::errc error{};
};

Read read(Reader reader, std::string_view text) {
  Read result;
  const auto [stop, error] = reader(text.data(), text.data() + text.size(), result.number);
  result.length = static_cast<std::size_t>(stop - text.data());
  result.error = error;
  return result;
}

TEST_CASE("the locale of a program does not matter") {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  bool has_comma = false;
  for (const char* name : {"de_DE.UTF-8", "de_DE", "German_Germany.1252", "fr_FR.UTF-8"}) {
    has_comma = std::setlocale(LC_NUMERIC, name) != nullptr && std::string(std::localeconv()->decimal_point) == ",";
    if (has_comma) break;
  }
  if (!has_comma) MESSAGE("this system has no locale with a comma: only the usual one is tested");
  for (const Reader reader : readers) CHECK(read(reader, "2.5,7").number == 2.5);
  for (const Writer writer : writers) {
    NumberText text{};
    CHECK(std::string_view(text.data(), static_cast<std::size_t>(writer(text, 2.5) - text.data())) == "2.5");
  }
  std::setlocale(LC_NUMERIC, before.c_str());
}

TEST_CASE("a text becomes the double nearest to it, to where the number ends") {
  struct Case {
    std::string_view text;
    Real number;
    std::size_t length;
  };
  const Real infinite = std::numeric_limits<Real>::infinity();
  const Case cases[] = {
      {"0", 0, 1},
      {"-1.25", -1.25, 5},
      {"1e-3", 1e-3, 4},
      {".5", 0.5, 2},
      {"5.", 5, 2},
      {"1e5x", 1e5, 3},
      {"2e", 2, 1},
      {"2e+", 2, 1},
      {"2e+2", 200, 4},
      {"0x10", 0, 1},
      {"3 4", 3, 1},
      {"9007199254740993", 9007199254740992.0, 16},
      {"2.2250738585072011e-308", 2.2250738585072011e-308, 23},
      {"4.9406564584124654e-324", 4.9406564584124654e-324, 23},
      {"1.7976931348623157e308", 1.7976931348623157e308, 22},
      {"0.1000000000000000055511151231257827021181583404541015625000000001", 0.1, 66},
      {"inf", infinite, 3},
      {"-Infinity", -infinite, 9},
      {"infinit", infinite, 3},
  };
  for (const Reader reader : readers) {
    for (const Case& each : cases) {
      CAPTURE(each.text);
      const Read found = read(reader, each.text);
      CHECK(found.error == std::errc());
      CHECK(found.length == each.length);
      CHECK(std::bit_cast<std::uint64_t>(found.number) == std::bit_cast<std::uint64_t>(each.number));
    }
    CHECK(std::signbit(read(reader, "-0").number));
    for (const std::string_view text : {"nan", "-NaN", "nan(abc_1)"}) {
      CHECK(std::isnan(read(reader, text).number));
      CHECK(read(reader, text).length == text.size());
    }
    CHECK(read(reader, "nan(a-b)").length == 3);
  }
}

TEST_CASE("text that is not a number, or out of the range of a double, leaves the value unchanged") {
  for (const Reader reader : readers) {
    for (const std::string_view text : {"", "-", ".", "+1", " 1", "e5", "-.e1", "--1", "in", "x"}) {
      CAPTURE(text);
      CHECK(read(reader, text).error == std::errc::invalid_argument);
      CHECK(read(reader, text).length == 0);
      CHECK(read(reader, text).number == untouched);
    }
    for (const std::string_view text : {"1e309", "-1e309", "1e-400", "-0.5e-330"}) {
      CAPTURE(text);
      CHECK(read(reader, text).error == std::errc::result_out_of_range);
      CHECK(read(reader, text).length == text.size());
      CHECK(read(reader, text).number == untouched);
    }
    CHECK(read(reader, "0e-400").error == std::errc());
  }
}

TEST_CASE("any double is read back from its text, which is as short as can be") {
  std::mt19937_64 random(5);
  for (int i = 0; i < 20000; ++i) {
    const auto number = std::bit_cast<Real>(random());
    if (!std::isfinite(number)) continue;
    for (const Writer writer : writers) {
      NumberText text;
      const std::string written(text.data(), writer(text, number));
      CAPTURE(written);
      REQUIRE(written.size() <= 24);
      for (const Reader reader : readers) {
        const Read found = read(reader, written);
        REQUIRE(found.length == written.size());
        REQUIRE(std::bit_cast<std::uint64_t>(found.number) == std::bit_cast<std::uint64_t>(number));
      }
    }
  }
  for (const Writer writer : writers) {
    NumberText text;
    CHECK(std::string(text.data(), writer(text, 0.1)) == "0.1");
    CHECK(std::string(text.data(), writer(text, -2.5)) == "-2.5");
  }
}

}  // namespace test_number_text
