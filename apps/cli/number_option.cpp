#include "number_option.h"

#include <charconv>
#include <limits>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"

namespace pliant_cli {
namespace {

/// Reads the whole of a text, or says what is wanted in its place.
template <class Number>
Number to_number(const std::string& option, const std::string& text, std::string_view wanted, Number least,
                 Number most) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  const bool is_number = stop == end && error != std::errc::invalid_argument;
  if (is_number && error == std::errc{} && !(number < least) && !(most < number)) return number;
  pliant::fail_input(fmt::format("{}: '{}' {}; give {}", option, pliant::printable(text, 60),
                                 is_number ? "is out of range" : "is not a number of that kind", wanted));
}

template <class Number>
std::string wanted_text(Number least, Number most) {
  if constexpr (!std::is_integral_v<Number>) return "a number, such as 0.01 or 1e-2";
  // The largest is named, since some try it for "for ever".
  const std::string first = least == std::numeric_limits<Number>::lowest() ? "" : fmt::format("from {} ", least);
  return fmt::format("a whole number {}up to {}, without point and exponent", first, most);
}

/// `Target` is a number, or an optional one.
template <class Number, class Target>
void add(CLI::App& command, const std::string& name, Target& target, const std::string& help,
         Number least = std::numeric_limits<Number>::lowest(), Number most = std::numeric_limits<Number>::max()) {
  const auto take = [&target, name, least, most](const std::string& text) {
    target = to_number<Number>(name, text, wanted_text(least, most), least, most);
  };
  command.add_option_function<std::string>(name, take, help)->type_name(std::is_integral_v<Number> ? "INT" : "FLOAT");
}

}  // namespace

void add_number(CLI::App& command, const std::string& name, std::optional<pliant::Index>& number, NumberWord word,
                const std::string& help) {
  constexpr pliant::Index least = std::numeric_limits<pliant::Index>::lowest();
  constexpr pliant::Index most = std::numeric_limits<pliant::Index>::max();
  const std::string wanted = fmt::format("{}, or {}", wanted_text(least, most), word.text);
  const auto take = [&number, name, wanted, word = std::move(word)](const std::string& text) {
    if (text == word.text) return word.take();
    number = to_number<pliant::Index>(name, text, wanted, least, most);
  };
  command.add_option_function<std::string>(name, take, help)->type_name("INT");
}

void add_number(CLI::App& command, const std::string& name, std::optional<std::int64_t>& number,
                const std::string& help) {
  add<std::int64_t>(command, name, number, help);
}

void add_number(CLI::App& command, const std::string& name, std::optional<pliant::Index>& number,
                const std::string& help) {
  add<pliant::Index>(command, name, number, help);
}

void add_number(CLI::App& command, const std::string& name, std::optional<pliant::Real>& number,
                const std::string& help) {
  add<pliant::Real>(command, name, number, help);
}

void add_number(CLI::App& command, const std::string& name, std::int64_t& number, const std::string& help) {
  add<std::int64_t>(command, name, number, help);
}

void add_number(CLI::App& command, const std::string& name, pliant::Real& number, const std::string& help) {
  add<pliant::Real>(command, name, number, help);
}

void add_number(CLI::App& command, const std::string& name, std::int64_t& number, const WholeRange& range,
                const std::string& help) {
  add<std::int64_t>(command, name, number, help, range[0], range[1]);
}

void add_number(CLI::App& command, const std::string& name, std::optional<std::int64_t>& number,
                const WholeRange& range, const std::string& help) {
  add<std::int64_t>(command, name, number, help, range[0], range[1]);
}

void add_count(CLI::App& command, const std::string& name, std::int64_t& number, const std::string& help) {
  add<std::int64_t>(command, name, number, help, 1);
}

}  // namespace pliant_cli
