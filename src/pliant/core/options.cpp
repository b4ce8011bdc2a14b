#include "pliant/core/options.h"

#include <sstream>

namespace pliant::detail {

void check_number(std::string_view type, const OptionInfo& info, Real number, std::size_t index, bool is_list) {
  const Range& range = info.range;
  const bool above = range.excludes_min ? number > range.min : number >= range.min;
  if (std::isfinite(number) && above && number <= range.max) return;
  std::ostringstream message;
  message.imbue(std::locale::classic());
  message << type << ": " << info.name;
  if (is_list) message << '[' << index << ']';
  message << ": " << number << " is out of range; give a finite number";
  if (range.min > any_number.min) message << (range.excludes_min ? " above " : " from ") << range.min;
  if (range.max < any_number.max) message << " up to " << range.max;
  if (!info.unit.empty()) message << " [" << info.unit << ']';
  fail_input(message.str());
}

}  // namespace pliant::detail
