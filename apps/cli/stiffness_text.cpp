#include "stiffness_text.h"

#include <fmt/format.h>

namespace pliant_cli {

std::string stiffness_text(const pliant::StiffnessRange& range) {
  const auto numbers = [&range](pliant::Real factor) {
    const std::string least = fmt::format("{:.4g}", factor * range.least);
    const std::string most = fmt::format("{:.4g}", factor * range.most);
    return least == most ? least : least + " to " + most;
  };
  std::string text = "stiffness " + numbers(1);
  if (!range.unit.empty()) text += fmt::format(" {}", range.unit);
  return range.taut_factor > 1 ? text + fmt::format(", {} once taut", numbers(range.taut_factor)) : text;
}

}  // namespace pliant_cli
