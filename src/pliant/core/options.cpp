#include "pliant/core/options.h"

#include <sstream>

#include <fmt/format.h>

namespace pliant {

std::optional<std::string> range_error(const OptionInfo& info, Real number) {
  const Range& range = info.range;
  if (!info.word.empty() && number == info.number_of_word) return std::nullopt;
  const bool above = range.excludes_min ? number > range.min : number >= range.min;
  if (std::isfinite(number) && above && number <= range.max) return std::nullopt;
  std::ostringstream message;
  message.imbue(std::locale::classic());
  message << number << " is out of range; give a finite number";
  if (range.min > any_number.min) message << (range.excludes_min ? " above " : " from ") << range.min;
  if (range.max < any_number.max) message << " up to " << range.max;
  if (!info.word.empty()) message << ", or `" << info.word << '`';
  if (!info.unit.empty()) message << " [" << info.unit << ']';
  return message.str();
}

void detail::check_number(std::string_view type, const OptionInfo& info, Real number, std::size_t index, bool is_list) {
  const std::optional<std::string> error = range_error(info, number);
  if (!error) return;
  const std::string place = is_list ? fmt::format("{}[{}]", info.name, index) : std::string(info.name);
  fail_input(fmt::format("{}: {}: {}", type, place, *error));
}

}  // namespace pliant
