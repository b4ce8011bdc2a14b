#include "pliant_io/scene/nearest_names.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "pliant/core/printable.h"

namespace pliant {
namespace {

std::string in_small_letters(std::string_view text) {
  std::string small(text);
  for (char& c : small) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return small;
}

/// Insertions, deletions and replacements of bytes, and swaps of neighbors, that turn a into b.
std::size_t slip_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      row[j + 1] = std::min({last[j] + (a[i] == b[j] ? 0U : 1U), last[j + 1] + 1, row[j] + 1});
      const bool is_swap = i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j];
      if (is_swap) row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last.back();
}

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
  constexpr std::size_t compared = 64;  // no key is longer, and the cost grows with the lengths
  word = word.substr(0, compared);
  const std::string small_word = in_small_letters(word);
  std::vector<std::tuple<bool, std::size_t, std::size_t>> distances;
  distances.reserve(names.size());
  for (const std::string_view name : names) {
    const std::string small_name = in_small_letters(name.substr(0, compared));
    const bool is_beginning = !word.empty() && small_name.starts_with(small_word);
    distances.emplace_back(!is_beginning, edit_distance(small_word, small_name),
                           edit_distance(word, name.substr(0, compared)));
  }
  std::vector<std::size_t> order(names.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return distances[i]; });
  std::vector<std::string_view> ordered;
  ordered.reserve(names.size());
  for (const std::size_t i : order) ordered.push_back(names[i]);
  return ordered;
}

std::string nearest_names_text(std::string_view word, std::vector<std::string_view> names) {
  constexpr std::size_t shown = 24;
  std::string text;
  const std::vector<std::string_view> ordered = nearest_names(word, std::move(names));
  for (std::size_t i = 0; i < std::min(shown, ordered.size()); ++i) {
    text += (i == 0 ? "" : ", ") + printable(ordered[i], 64);
  }
  return ordered.size() > shown ? text + ", ..." : text;
}

std::string did_you_mean(std::string_view word, std::vector<std::string_view> names) {
  constexpr std::size_t most = 3;
  constexpr std::size_t compared = 64;
  const std::string small_word = in_small_letters(word.substr(0, compared));
  std::vector<std::pair<std::size_t, std::string_view>> near;
  for (const std::string_view name : names) {
    const std::string small_name = in_small_letters(name.substr(0, compared));
    const bool is_beginning = !word.empty() && small_name.starts_with(small_word);
    const std::size_t slips = is_beginning ? 0 : slip_distance(small_word, small_name);
    if (3 * slips <= std::max(small_word.size(), small_name.size()) && (is_beginning || !word.empty())) {
      near.emplace_back(slips, name);
    }
  }
  std::ranges::stable_sort(near, {}, [](const auto& entry) { return entry.first; });
  near.resize(std::min(near.size(), most));
  std::string text;
  for (std::size_t i = 0; i < near.size(); ++i) {
    text += i == 0 ? "; did you mean '" : i + 1 == near.size() ? "' or '" : "', '";
    text += printable(near[i].second, 64);
  }
  return text.empty() ? text : text + "'?";
}

}  // namespace pliant
