#include "pliant/scene/nearest_names.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pliant {
namespace {

/// Insertions, deletions and replacements of bytes that turn a into b.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> distances(b.size() + 1);
  std::iota(distances.begin(), distances.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = i;
    distances[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = distances[j + 1];
      distances[j + 1] = std::min({replaced, diagonal + 1, distances[j] + 1});
    }
  }
  return distances.back();
}

}  // namespace

std::vector<std::string_view> nearest_names(std::string_view word, std::vector<std::string_view> names) {
  word = word.substr(0, 64);  // no name is longer, and the cost grows with the length
  std::ranges::stable_sort(names, {}, [&](std::string_view name) {
    const bool is_beginning = !word.empty() && name.starts_with(word);
    return std::pair(!is_beginning, edit_distance(word, name));
  });
  return names;
}

std::string nearest_names_text(std::string_view word, std::vector<std::string_view> names) {
  return fmt::format("{}", fmt::join(nearest_names(word, std::move(names)), ", "));
}

}  // namespace pliant
