#pragma once
// Values that are tried in the place of one of a scene's, and the product of several such lists.
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pliant_sweep {

/// Values as they were written: JSON, or texts where they are none.
struct Variation {
  std::string path;  ///< as `--set` takes it: "bodies[sheet].constraints[bend].stiffness"
  std::vector<std::string> values;
};

/// A value for each variation.
using Combination = std::vector<std::string>;

/// More than anyone waits for.
inline constexpr std::size_t max_runs = 10'000;

/// Reads "PATH=a,b,c". Commas in brackets, braces and quotes do not separate. `1:9:5` stands for five values evenly
/// from 1 to 9, `1:9:5log` for five by equal ratios.
/// @throws pliant::Error (input): no path, no or an empty value, a range that is none, a value twice, over max_runs
Variation read_variation(std::string_view text);

/// All combinations, the values of the last variation changing fastest.
/// @throws pliant::Error (input): no variation, a path twice, over max_runs combinations
std::vector<Combination> product_of(const std::vector<Variation>& variations);

/// The same text for all ways to write the same value: `[1, 2]` and `[1,2]`, `a` and `"a"`, `0.10` and `0.1`.
std::string canonical_value(std::string_view value);

/// The value as a table has it: a text of JSON without its quotes, every other as it was given.
std::string plain_value(std::string_view value);

/// None for what is no number.
std::optional<double> number_of(std::string_view value);

/// "a=1, b=[0,1,0]", for people.
std::string combination_text(const std::vector<Variation>& variations, const Combination& values);

}  // namespace pliant_sweep
