#include "sweep/variation.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"

namespace pliant_sweep {
namespace {

using Json = nlohmann::json;

constexpr std::string_view value_example = "write PATH=a,b,c, such as settings.iterations=5,10,20";

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// The parts between the commas that stand outside of brackets, braces and quotes.
std::vector<std::string_view> split_values(std::string_view text) {
  std::vector<std::string_view> parts;
  std::size_t begin = 0;
  int depth = 0;
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_quoted) {
      if (c == '\\') ++i;
      if (c == '"') is_quoted = false;
    } else if (c == '"') {
      is_quoted = true;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      depth = std::max(0, depth - 1);
    } else if (c == ',' && depth == 0) {
      parts.push_back(trimmed(text.substr(begin, i - begin)));
      begin = i + 1;
    }
  }
  parts.push_back(trimmed(text.substr(begin)));
  return parts;
}

template <class Number>
std::optional<Number> whole_number(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

[[noreturn]] void fail_range(std::string_view text, std::string_view why) {
  pliant::fail_input(
      fmt::format("'{}' is not a range: {}; write FIRST:LAST:COUNT or FIRST:LAST:COUNTlog, such as 1:9:5, "
                  "and a text with colons in quotes",
                  pliant::printable(text, 60), why));
}

/// Whether a value is meant as a range: it begins with a number and a colon.
bool is_range(std::string_view text) {
  const std::size_t colon = text.find(':');
  return colon != text.npos && number_of(text.substr(0, colon)).has_value();
}

/// Twelve digits, so that the third of five values from 0.1 to 0.5 is 0.3.
std::string rounded(double value) {
  return fmt::format("{:.12g}", value);
}

std::vector<std::string> values_of_range(std::string_view text) {
  const std::size_t first_colon = text.find(':');
  const std::size_t second_colon = text.find(':', first_colon + 1);
  if (second_colon == text.npos) fail_range(text, "it has no count");
  const std::string_view ends[] = {text.substr(0, first_colon),
                                   text.substr(first_colon + 1, second_colon - first_colon - 1)};
  std::string_view count_text = text.substr(second_colon + 1);
  const bool is_logarithmic = count_text.ends_with("log");
  if (is_logarithmic) count_text.remove_suffix(3);
  const auto first = number_of(ends[0]);
  const auto last = number_of(ends[1]);
  const auto count = whole_number<std::size_t>(count_text);
  if (!last) fail_range(text, "its last value is not a number");
  if (!count || *count < 2 || *count > max_runs) {
    fail_range(text, fmt::format("its count is not a number from 2 to {}", max_runs));
  }
  if (is_logarithmic && !(*first > 0 && *last > 0)) fail_range(text, "equal ratios need values above 0");
  std::vector<std::string> values = {std::string(ends[0])};
  for (std::size_t i = 1; i + 1 < *count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(*count - 1);
    values.push_back(rounded(is_logarithmic ? std::exp(std::log(*first) * (1 - share) + std::log(*last) * share)
                                            : *first * (1 - share) + *last * share));
  }
  values.emplace_back(ends[1]);
  return values;
}

void check_values(const Variation& variation) {
  if (variation.values.size() > max_runs) {
    pliant::fail_input(fmt::format("{} values make more than {} runs; give fewer", variation.values.size(), max_runs));
  }
  std::set<std::string> seen;
  for (const std::string& value : variation.values) {
    if (value.empty()) {
      pliant::fail_input(fmt::format("there is a value without text; {}, and \"\" for an empty text", value_example));
    }
    if (!seen.insert(canonical_value(value)).second) {
      pliant::fail_input(fmt::format("the value {} comes twice; give it once", pliant::printable(value, 60)));
    }
  }
}

}  // namespace

std::optional<double> number_of(std::string_view value) {
  const auto number = whole_number<double>(value);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::string canonical_value(std::string_view value) {
  constexpr int max_depth = 100;  // the text of a value is made by recursion; no scene goes as deep
  bool is_too_deep = false;
  const auto check_depth = [&is_too_deep](int depth, Json::parse_event_t, const Json&) {
    is_too_deep = is_too_deep || depth > max_depth;
    return !is_too_deep;
  };
  Json json = Json::parse(value, check_depth, false);
  if (is_too_deep || json.is_discarded()) json = value;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string plain_value(std::string_view value) {
  if (!value.starts_with('"')) return std::string(value);
  const Json json = Json::parse(value, nullptr, false);
  return json.is_string() ? json.get<std::string>() : std::string(value);
}

Variation read_variation(std::string_view text) {
  return pliant::at_place(fmt::format("--vary {}", pliant::printable(text)), [&] {
    const std::size_t equals = text.find('=');
    if (equals == text.npos) pliant::fail_input(fmt::format("there is no '='; {}", value_example));
    if (equals == 0) pliant::fail_input(fmt::format("there is no path; {}", value_example));
    Variation variation{std::string(text.substr(0, equals)), {}};
    const std::string_view values = text.substr(equals + 1);
    if (trimmed(values).empty()) pliant::fail_input(fmt::format("there are no values; {}", value_example));
    for (const std::string_view value : split_values(values)) {
      if (!is_range(value)) {
        variation.values.emplace_back(value);
        continue;
      }
      const std::vector<std::string> range = values_of_range(value);
      variation.values.insert(variation.values.end(), range.begin(), range.end());
    }
    check_values(variation);
    return variation;
  });
}

std::vector<Combination> product_of(const std::vector<Variation>& variations) {
  if (variations.empty()) pliant::fail_input(fmt::format("--vary is missing; {}", value_example));
  std::set<std::string> paths;
  std::size_t count = 1;
  for (const Variation& variation : variations) {
    if (!paths.insert(variation.path).second) {
      pliant::fail_input(
          fmt::format("--vary: {} comes twice; give all of its values at once", pliant::printable(variation.path)));
    }
    count *= variation.values.size();  // both at most max_runs
    if (count == 0 || count > max_runs) {
      pliant::fail_input(fmt::format("--vary: {} make {} runs; give fewer values, of several sweeps if need be",
                                     variations.size() > 1 ? "the products of all values" : "its values",
                                     count == 0 ? "no" : fmt::format("more than {}", max_runs)));
    }
  }
  std::vector<Combination> all = {{}};
  for (const Variation& variation : variations) {
    std::vector<Combination> longer;
    for (const Combination& combination : all) {
      for (const std::string& value : variation.values) {
        longer.push_back(combination);
        longer.back().push_back(value);
      }
    }
    all = std::move(longer);
  }
  return all;
}

std::string combination_text(const std::vector<Variation>& variations, const Combination& values) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!text.empty()) text += ", ";
    text += fmt::format("{}={}", pliant::printable(variations[i].path), pliant::printable(values[i], 60));
  }
  return text;
}

}  // namespace pliant_sweep
