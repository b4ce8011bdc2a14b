#pragma once
// Options whose values are the names of an enumeration.
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pliant/core/printable.h"
#include "pliant_io/scene/nearest_names.h"

namespace pliant_cli {

template <class Choice>
struct ChoiceOf {
  using Type = Choice;
};
template <class Choice>
struct ChoiceOf<std::optional<Choice>> {
  using Type = Choice;
};

/// Takes only these words, and shows them in the help.
inline CLI::Validator one_of(std::vector<std::string_view> names) {
  const auto refusal = [names](const std::string& value) -> std::string {
    if (std::ranges::find(names, std::string_view(value)) != names.end()) return "";
    return fmt::format("unknown value '{}'{} (known: {})", pliant::printable(value, 60),
                       pliant::did_you_mean(value, names), fmt::join(names, ", "));
  };
  return CLI::Validator(refusal, fmt::format("{{{}}}", fmt::join(names, ",")));
}

/// `target` is an enumeration with choice_names, or an optional one.
template <class Target>
CLI::Option& add_choice(CLI::App& command, const std::string& name, Target& target, const std::string& help) {
  using Choice = typename ChoiceOf<Target>::Type;
  constexpr auto names = choice_names(Choice{});
  const auto take = [&target, names](const std::string& value) {
    target = static_cast<Choice>(std::ranges::find(names, std::string_view(value)) - names.begin());
  };
  CLI::Option* option = command.add_option_function<std::string>(name, take, help);
  return *option->type_name("WORD")->check(one_of({names.begin(), names.end()}));
}

}  // namespace pliant_cli
