#pragma once
// Options whose values are numbers, in the decimal notation of C++ and JSON, whatever the locale.
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "pliant/core/types.h"

namespace pliant_cli {

/// Whole numbers are written without point and exponent. What is none, or past the type, is refused with what is
/// wanted.
void add_number(CLI::App& command, const std::string& name, std::optional<std::int64_t>& number,
                const std::string& help);
void add_number(CLI::App& command, const std::string& name, std::optional<pliant::Index>& number,
                const std::string& help);
void add_number(CLI::App& command, const std::string& name, std::optional<pliant::Real>& number,
                const std::string& help);
/// A word that may stand in place of a number, and what it does.
struct NumberWord {
  std::string text;
  std::function<void()> take;
};
void add_number(CLI::App& command, const std::string& name, std::optional<pliant::Index>& number, NumberWord word,
                const std::string& help);
/// `number` keeps its value when the option is not given.
void add_number(CLI::App& command, const std::string& name, std::int64_t& number, const std::string& help);
void add_number(CLI::App& command, const std::string& name, pliant::Real& number, const std::string& help);

/// Whole numbers from the first to the second.
using WholeRange = std::array<std::int64_t, 2>;
void add_number(CLI::App& command, const std::string& name, std::int64_t& number, const WholeRange& range,
                const std::string& help);
void add_number(CLI::App& command, const std::string& name, std::optional<std::int64_t>& number,
                const WholeRange& range, const std::string& help);

/// From 1 on.
void add_count(CLI::App& command, const std::string& name, std::int64_t& number, const std::string& help);

}  // namespace pliant_cli
