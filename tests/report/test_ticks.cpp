#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <string>
#include <string_view>

#include <doctest/doctest.h>

#include "report/ticks.h"
#include "tests/core/random.h"

namespace test_ticks {

using namespace pliant_report;
using pliant_tests::Random;

namespace {

std::vector<std::string> labels(const Ticks& ticks) {
  std::vector<std::string> result;
  for (const Tick& tick : ticks.ticks) {
    if (!tick.label.empty()) result.push_back(tick.label);
  }
  return result;
}

using Labels = std::vector<std::string>;

std::string replaced(std::string_view text, std::string_view what, std::string_view by) {
  std::string result;
  for (std::size_t at = text.find(what); at != std::string_view::npos; at = text.find(what)) {
    result.append(text.substr(0, at)).append(by);
    text.remove_prefix(at + what.size());
  }
  return result.append(text);
}

/// What a reader takes a label for: "−2.50", "10⁻³", "2×10⁵".
double read(std::string label) {
  constexpr std::string_view raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  const bool is_power = label.find("10⁻") != std::string::npos ||
                        std::any_of(std::begin(raised), std::end(raised),
                                    [&](std::string_view digit) { return label.find(digit) != std::string::npos; });
  if (is_power && label.starts_with("10")) label = "1×" + label;
  label = replaced(label, "×10", "e");
  label = replaced(replaced(label, "−", "-"), "⁻", "-");
  for (int digit = 0; digit < 10; ++digit) {
    label = replaced(label, raised[digit], std::to_string(digit));
  }
  char* end = nullptr;
  const double value = std::strtod(label.c_str(), &end);
  CHECK_MESSAGE(*end == '\0', label);
  return value;
}

}  // namespace

TEST_CASE("linear ticks are multiples of 1, 2 or 5, with as many decimals as they need") {
  CHECK(labels(linear_ticks(0, 1, 7)) == Labels{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"});
  CHECK(labels(linear_ticks(-3.2, 4.9, 5)) == Labels{"−2", "0", "2", "4"});
  CHECK(labels(linear_ticks(0.3, 0.9, 7)) == Labels{"0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9"});
  CHECK(labels(linear_ticks(0, 12000, 4)) == Labels{"0", "5000", "10000"});
}

TEST_CASE("numbers too long to read are told in a power of ten") {
  const Ticks large = linear_ticks(0, 3.1e6, 4);
  CHECK(large.power == 6);
  CHECK(labels(large) == Labels{"0", "1", "2", "3"});
  const Ticks small = linear_ticks(-2e-7, 4.2e-7, 4);
  CHECK(small.power == -9);
  CHECK(labels(small) == Labels{"−200", "0", "200", "400"});
  // 10⁵ that differ by hundredths would need all their digits in any unit.
  const Ticks near = linear_ticks(100000, 100000.1, 3);
  CHECK(near.power == 0);
  CHECK(labels(near) == Labels{"100000.00", "100000.05", "100000.10"});
}

TEST_CASE("the power of ten goes into the unit of the label") {
  CHECK(with_power("length [m]", 0) == "length [m]");
  CHECK(with_power("length [m]", 3) == "length [10³ m]");
  CHECK(with_power("energy", -12) == "energy [10⁻¹²]");
  CHECK(with_power("share [–]", -3) == "share [10⁻³]");
  CHECK(with_power("", 6) == "[10⁶]");
}

TEST_CASE("linear ticks of any range lie in it, are evenly spaced, few enough, and their labels say where they are") {
  Random random(11);
  for (int i = 0; i < 4000; ++i) {
    const double size = std::pow(10.0, random.uniform(-280, 300));
    const double min = random.uniform(-1, 1) * size;
    const double width = std::abs(size) * std::pow(10.0, random.uniform(-9, 1));
    const double max = min + width;
    const int most = 3 + static_cast<int>(random.index(7));
    const Ticks ticks = linear_ticks(min, max, most);
    const std::vector<Tick>& list = ticks.ticks;
    CAPTURE(min);
    CAPTURE(max);
    REQUIRE(!list.empty());
    CHECK(static_cast<int>(list.size()) <= most);
    CHECK(static_cast<int>(list.size()) >= (most - 1) / 3);
    std::set<std::string> different;
    for (std::size_t j = 0; j < list.size(); ++j) {
      CHECK(list[j].at >= min - 1e-6 * width);
      CHECK(list[j].at <= max + 1e-6 * width);
      CHECK(std::abs(read(list[j].label) - list[j].at / std::pow(10.0, ticks.power)) <=
            1e-6 * width / std::pow(10.0, ticks.power));
      different.insert(list[j].label);
      if (j < 2) continue;
      CHECK(list[j].at - list[j - 1].at == doctest::Approx(list[1].at - list[0].at).epsilon(1e-4));
    }
    CHECK(different.size() == list.size());
  }
}

TEST_CASE("logarithmic ticks are decades, with 2 and 5 where there are few of them") {
  CHECK(labels(logarithmic_ticks(-6.2, 0.1, 9)) == Labels{"10⁻⁶", "10⁻⁵", "10⁻⁴", "10⁻³", "10⁻²", "10⁻¹", "10⁰"});
  CHECK(labels(logarithmic_ticks(-6.2, 0.1, 5)) == Labels{"10⁻⁶", "10⁻⁴", "10⁻²", "10⁰"});
  CHECK(labels(logarithmic_ticks(0, 3, 9)) == Labels{"1", "10", "100", "1000"});
  CHECK(labels(logarithmic_ticks(0, 1.5, 9)) == Labels{"1", "2", "5", "10", "20"});
  CHECK(labels(logarithmic_ticks(-5.4, -4.2, 9)) == Labels{"5×10⁻⁶", "10⁻⁵", "2×10⁻⁵", "5×10⁻⁵"});
  CHECK(labels(logarithmic_ticks(-300, 300, 9)) ==
        Labels{"10⁻³⁰⁰", "10⁻²⁰⁰", "10⁻¹⁰⁰", "10⁰", "10¹⁰⁰", "10²⁰⁰", "10³⁰⁰"});
}

TEST_CASE("a logarithmic axis of less than a decade has round numbers too") {
  CHECK(labels(logarithmic_ticks(std::log10(3.1), std::log10(3.9), 5)) == Labels{"3.2", "3.4", "3.6", "3.8"});
  const Ticks small = logarithmic_ticks(std::log10(3.1e-7), std::log10(3.9e-7), 5);
  CHECK(small.power == -9);
  CHECK(labels(small) == Labels{"320", "340", "360", "380"});
}

TEST_CASE("logarithmic ticks of any range lie in it in order, few enough, and their labels say where they are") {
  Random random(12);
  for (int i = 0; i < 4000; ++i) {
    const double min = random.uniform(-280, 280);
    const double max = min + std::pow(10.0, random.uniform(-6, 1.2));
    const int most = 3 + static_cast<int>(random.index(7));
    const Ticks ticks = logarithmic_ticks(min, max, most);
    CAPTURE(min);
    CAPTURE(max);
    const auto told = static_cast<int>(labels(ticks).size());
    CHECK(told >= 1);
    CHECK(told <= most);
    for (std::size_t j = 0; j < ticks.ticks.size(); ++j) {
      const Tick& tick = ticks.ticks[j];
      CHECK(tick.at >= min - 1e-6 * (max - min));
      CHECK(tick.at <= max + 1e-6 * (max - min));
      if (j > 0) CHECK(tick.at > ticks.ticks[j - 1].at);
      if (tick.label.empty()) continue;
      CHECK(std::abs(std::log10(read(tick.label)) + ticks.power - tick.at) <= 1e-6 * (max - min) + 1e-12);
    }
  }
}

}  // namespace test_ticks
