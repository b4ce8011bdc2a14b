// Exponents become powers of ten, and names stay what they are.
#include <doctest/doctest.h>

#include "report/typeset.h"

namespace test_typeset {

using pliant_report::with_powers;

TEST_CASE("numbers with exponents become powers of ten") {
  CHECK(with_powers("k = 5e+04 N/m") == "k = 5·10⁴ N/m");
  CHECK(with_powers("1e-9 m") == "10⁻⁹ m");
  CHECK(with_powers("4.19e+05, -2.6e-011") == "4.19·10⁵, -2.6·10⁻¹¹");
  CHECK(with_powers("(1e4)") == "(10⁴)");
  CHECK(with_powers("1e100.") == "10¹⁰⁰.");
  CHECK(with_powers("2e0") == "2·10⁰");
}

TEST_CASE("what only looks like one stays") {
  for (const char* text : {"", "e", "1e", "1e+", "e5", "run_1e5", "a1e5", "1e5b", "1e5_x", "0x1e5", "1.2.3e4", "1e5.5",
                           "v1.2e3x", "30 m/s", "12e x", "ä1e5"}) {
    CHECK(with_powers(text) == text);
  }
}

TEST_CASE("the page and its plots have powers, the data do not") {
  pliant_report::Report report{"1e5", "2e5", {}, {{"n-1e5", "3e5", "4e5", {{"5e5", "6e5", {}, "7e5"}}}}};
  report.chapters[0].blocks.emplace_back(pliant_report::Plot{
      .title = "8e5", .caption = "9e5", .x = {.label = "2e6"}, .y = {.label = "3e6"}, .series = {{.name = "4e6"}}});
  report.chapters[0].blocks.emplace_back(pliant_report::Table{"5e6", {"6e6"}, {{"7e6"}}});
  const std::string page = pliant_report::to_html(report);
  for (const char* printed : {"2·10⁵", "3·10⁵", "4·10⁵", "5·10⁵", "7·10⁵", "8·10⁵", "9·10⁵", "2·10⁶", "3·10⁶", "5·10⁶",
                              "6·10⁶", "7·10⁶", "id=\"n-1e5\""}) {
    CAPTURE(printed);
    CHECK(page.find(printed) != std::string::npos);
  }
  CHECK(pliant_report::to_json(report).find("5e5") != std::string::npos);
}

}  // namespace test_typeset
