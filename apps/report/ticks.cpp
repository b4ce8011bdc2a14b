#include "report/ticks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace pliant_report {
namespace {

constexpr double rounding = 1e-9;  ///< of a step: sums of decimal fractions miss their round values by less

/// i · digit · 10^exponent. Negative powers of ten have no exact value, positive ones do: one division rounds once.
double multiple(double i, int digit, int exponent) {
  const double power = std::pow(10.0, std::abs(exponent));
  return exponent < 0 ? i * digit / power : i * digit * power;
}

std::string with_minus(std::string text) {
  if (text.starts_with('-')) text.replace(0, 1, "−");
  return text;
}

/// Steps as round numbers: digit · 10^exponent.
struct Step {
  int digit = 1;
  int exponent = 0;
  double first = 0;  ///< the multiples of the step that lie in the range
  double last = 0;
};

Step round_step(double min, double max, int max_count) {
  Step step;
  step.exponent = static_cast<int>(std::floor(std::log10((max - min) / max_count))) - 1;
  for (;; ++step.exponent) {
    for (const int digit : {1, 2, 5}) {
      step.digit = digit;
      const double size = multiple(1, digit, step.exponent);
      step.first = std::ceil(min / size - rounding);
      step.last = std::floor(max / size + rounding);
      if (step.last - step.first < max_count) return step;
    }
  }
}

/// The power of ten to take out of multiples of the step up to `largest`; 0 where they are easily read as they are, or
/// where it would but move digits behind the point.
int common_power(double largest, const Step& step) {
  const bool is_long = largest >= 99999.5 && (step.exponent >= 0 || largest >= 1e9);
  if (!is_long && largest >= 0.999e-2) return 0;
  return 3 * static_cast<int>(std::floor((std::log10(largest) + rounding) / 3));
}

/// The digits whose multiples of powers of ten are told by their labels, and whether those are plain numbers.
struct Labeling {
  std::vector<int> digits{};
  int stride = 1;  ///< of decades
  bool is_plain = false;
};

std::string logarithmic_label(int digit, int exponent, bool is_plain) {
  if (is_plain) return fmt::format("{:.{}f}", multiple(1, digit, exponent), std::max(0, -exponent));
  return digit == 1 ? power_of_ten(exponent) : fmt::format("{}×{}", digit, power_of_ten(exponent));
}

struct Decades {
  double min = 0;
  double max = 0;

  bool has(double at) const { return at >= min - rounding && at <= max + rounding; }
  int first() const { return static_cast<int>(std::floor(min)); }
  int last() const { return static_cast<int>(std::ceil(max)); }
  double width() const { return max - min; }
};

Ticks logarithmic_ticks(const Decades& decades, const Labeling& labeling, bool has_all_digits) {
  Ticks result;
  for (int exponent = decades.first(); exponent <= decades.last(); ++exponent) {
    for (int digit = 1; digit <= (has_all_digits ? 9 : 1); ++digit) {
      const double at = exponent + std::log10(digit);
      if (!decades.has(at)) continue;
      const bool is_told = exponent % labeling.stride == 0 &&
                           std::find(labeling.digits.begin(), labeling.digits.end(), digit) != labeling.digits.end();
      if (!is_told && labeling.stride > 10) continue;
      result.ticks.push_back({at, is_told ? logarithmic_label(digit, exponent, labeling.is_plain) : std::string()});
    }
  }
  return result;
}

int label_count(const Ticks& ticks) {
  return static_cast<int>(
      std::count_if(ticks.ticks.begin(), ticks.ticks.end(), [](const Tick& tick) { return !tick.label.empty(); }));
}

/// Every decade, or every second, third, ...
Ticks decade_ticks(const Decades& decades, bool is_plain, int max_count) {
  constexpr double widest_with_digits = 5.5;
  for (const int stride : {1, 2, 3, 5, 10, 20, 50, 100}) {
    Ticks ticks =
        logarithmic_ticks(decades, {{1}, stride, is_plain}, stride == 1 && decades.width() <= widest_with_digits);
    if (label_count(ticks) <= max_count) return ticks;
  }
  return logarithmic_ticks(decades, {{1}, 200, is_plain}, false);
}

}  // namespace

Ticks linear_ticks(double min, double max, int max_count) {
  const Step step = round_step(min, max, max_count);
  Ticks result;
  const double largest =
      multiple(std::max({std::abs(step.first), std::abs(step.last), 1.0}), step.digit, step.exponent);
  result.power = common_power(largest, step);
  const int exponent = step.exponent - result.power;
  for (double i = step.first; i <= step.last; ++i) {
    const double shown = multiple(i, step.digit, exponent) + 0.0;  // + 0.0: not "−0"
    result.ticks.push_back({multiple(i, step.digit, step.exponent) + 0.0,
                            with_minus(fmt::format("{:.{}f}", shown, std::max(0, -exponent)))});
  }
  return result;
}

Ticks logarithmic_ticks(double min, double max, int max_count) {
  const Decades decades{min, max};
  const bool is_plain = min >= -2 - rounding && max <= 5 - rounding;
  int powers = 0;
  for (int exponent = decades.first(); exponent <= decades.last(); ++exponent) powers += decades.has(exponent) ? 1 : 0;
  if (powers >= 3) return decade_ticks(decades, is_plain, max_count);
  const std::array<std::vector<int>, 3> choices = {{{1, 2, 5}, {1, 3}, {1}}};
  for (const std::vector<int>& digits : choices) {
    Ticks ticks = logarithmic_ticks(decades, {digits, 1, is_plain}, true);
    const int count = label_count(ticks);
    if (count <= max_count && (count >= 3 || decades.width() > 1)) return ticks;
  }
  Ticks ticks = linear_ticks(std::pow(10.0, min), std::pow(10.0, max), max_count);
  for (Tick& tick : ticks.ticks) tick.at = std::log10(tick.at);
  return ticks;
}

std::string power_of_ten(int power) {
  constexpr std::array<std::string_view, 10> digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string result = "10";
  for (const char c : fmt::format("{}", power)) {
    result += c == '-' ? std::string_view("⁻") : digits[static_cast<std::size_t>(c - '0')];
  }
  return result;
}

std::string with_power(std::string_view label, int power) {
  if (power == 0) return std::string(label);
  const std::size_t open = label.rfind('[');
  if (label.empty() || label.back() != ']' || open == std::string_view::npos) {
    return fmt::format("{}{}[{}]", label, label.empty() ? "" : " ", power_of_ten(power));
  }
  const std::string_view unit = label.substr(open + 1, label.size() - open - 2);
  const bool is_number = unit.empty() || unit == "1" || unit == "-" || unit == "–" || unit == "−";
  return fmt::format("{}[{}{}{}]", label.substr(0, open), power_of_ten(power), is_number ? "" : " ",
                     is_number ? std::string_view() : unit);
}

}  // namespace pliant_report
