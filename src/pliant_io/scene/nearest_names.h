#pragma once
// Suggestions for a word that is not on a list.
#include <string>
#include <string_view>
#include <vector>

namespace pliant {

/// The names that begin with `word`, then the others; each kind by the edits that turn one into the other (Levenshtein
/// distance), in which capitals count as small letters but between equals, then in the given order.
std::vector<std::string_view> nearest_names(std::string_view word, std::vector<std::string_view> names);

/// The first two dozen of them as text: "columns, rows, size".
std::string nearest_names_text(std::string_view word, std::vector<std::string_view> names);

/// "; did you mean 'columns' or 'rows'?" for at most three names that begin with `word`, or that few slips of the pen
/// (letters put in, left out, replaced or swapped: at most one in three) turn into it; "" when no name is that near.
std::string did_you_mean(std::string_view word, std::vector<std::string_view> names);

}  // namespace pliant
