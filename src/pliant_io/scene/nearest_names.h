#pragma once
// Suggestions for a word that is not on a list.
#include <string>
#include <string_view>
#include <vector>

namespace pliant {

/// At most three of the names: those that begin with `word`, then those that few slips of the pen (letters put in, left
/// out, replaced or swapped: at most one in three) turn into it, the nearest first. Capitals count as small letters but
/// between equals. None when nothing is near.
std::vector<std::string_view> near_names(std::string_view word, std::vector<std::string_view> names);

/// "; did you mean 'columns' or 'rows'?" for the near ones; "" when no name is near.
std::string did_you_mean(std::string_view word, std::vector<std::string_view> names);

/// What a message says after "unknown key 'colums'; ": "did you mean 'columns'? (known: rows, columns, size)", or
/// "known: rows, columns, size" when nothing is near. Of many names two dozen are named, or eight
/// beside a suggestion.
std::string suggestion_text(std::string_view word, const std::vector<std::string_view>& names);

}  // namespace pliant
