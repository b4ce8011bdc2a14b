#include "pliant_io/scene/nearest_names.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "pliant/core/printable.h"

namespace pliant {
namespace {

constexpr std::size_t compared = 64;     // letters: no key is longer, and the cost grows with the lengths
constexpr std::size_t shown = 24;        // names of a list
constexpr std::size_t shown_beside = 8;  // of one behind a suggestion

std::string in_small_letters(std::string_view text) {
  std::string small(text);
  for (char& c : small) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return small;
}

/// Insertions, deletions, replacements and swaps of neighbors, of bytes, that turn a into b.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1);  // for a without its last two bytes
  std::vector<std::size_t> last(b.size() + 1);    // without its last
  std::vector<std::size_t> distances(b.size() + 1);
  std::iota(distances.begin(), distances.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::swap(before, last);
    std::swap(last, distances);
    distances[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      distances[j + 1] = std::min({last[j] + (a[i] == b[j] ? 0U : 1U), last[j + 1] + 1, distances[j] + 1});
      const bool is_swap = i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j];
      if (is_swap) distances[j + 1] = std::min(distances[j + 1], before[j - 1] + 1);
    }
  }
  return distances.back();
}

std::string joined_names(std::span<const std::string_view> names, std::size_t most) {
  std::string text;
  for (const std::string_view name : names.first(std::min(most, names.size()))) {
    text += (text.empty() ? "" : ", ") + printable(name, 64);
  }
  return names.size() > most ? text + ", ..." : text;
}

/// "did you mean 'a', 'b' or 'c'?"; "" without names.
std::string question(std::span<const std::string_view> near) {
  std::string text;
  for (std::size_t i = 0; i < near.size(); ++i) {
    text += i == 0 ? "did you mean '" : i + 1 == near.size() ? "' or '" : "', '";
    text += printable(near[i], 64);
  }
  return text.empty() ? text : text + "'?";
}

}  // namespace

std::vector<std::string_view> near_names(std::string_view word, std::vector<std::string_view> names) {
  constexpr std::size_t most = 3;
  if (word.empty()) return {};
  word = word.substr(0, compared);
  const std::string small_word = in_small_letters(word);
  struct NearName {
    std::tuple<bool, std::size_t, std::size_t> distance;
    std::string_view name;
  };
  std::vector<NearName> near;
  for (const std::string_view name : names) {
    const std::string small_name = in_small_letters(name.substr(0, compared));
    const bool is_beginning = small_name.starts_with(small_word);
    const std::size_t edits = edit_distance(small_word, small_name);
    if (!is_beginning && 3 * edits > std::max(small_word.size(), small_name.size())) continue;
    near.push_back({{!is_beginning, edits, edit_distance(word, name.substr(0, compared))}, name});
  }
  std::ranges::stable_sort(near, {}, &NearName::distance);
  std::vector<std::string_view> nearest;
  for (const NearName& entry : near) {
    if (nearest.size() < most && std::ranges::find(nearest, entry.name) == nearest.end()) nearest.push_back(entry.name);
  }
  return nearest;
}

std::string did_you_mean(std::string_view word, std::vector<std::string_view> names) {
  const std::string text = question(near_names(word, std::move(names)));
  return text.empty() ? text : "; " + text;
}

std::string suggestion_text(std::string_view word, const std::vector<std::string_view>& names) {
  if (names.empty()) return "there is none";
  const std::string text = question(near_names(word, names));
  if (text.empty()) return "known: " + joined_names(names, shown);
  return fmt::format("{} (known: {})", text, joined_names(names, shown_beside));
}

}  // namespace pliant
