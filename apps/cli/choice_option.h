#pragma once
// Options whose values are the names of an enumeration.
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

namespace pliant_cli {

template <class Choice>
struct ChoiceOf {
  using Type = Choice;
};
template <class Choice>
struct ChoiceOf<std::optional<Choice>> {
  using Type = Choice;
};

/// `target` is an enumeration with choice_names, or an optional one.
template <class Target>
void add_choice(CLI::App& command, const std::string& name, Target& target, const std::string& help) {
  using Choice = typename ChoiceOf<Target>::Type;
  constexpr auto names = choice_names(Choice{});
  const auto take = [&target, names](const std::string& value) {
    target = static_cast<Choice>(std::ranges::find(names, std::string_view(value)) - names.begin());
  };
  command.add_option_function<std::string>(name, take, help)
      ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())));
}

}  // namespace pliant_cli
