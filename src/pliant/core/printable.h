#pragma once
// Text of the user's, made fit for messages.
#include <cstddef>
#include <string>
#include <string_view>

namespace pliant {

/// The text for one line on a terminal: control characters, marks that turn the direction of writing and bytes that are
/// no UTF-8 become spaces or '?'; what is longer than `limit` bytes is cut and ends with "...".
std::string printable(std::string_view text, std::size_t limit = 160);

/// The same for what matters at both ends, such as a path or a whole message: a long one loses its middle.
std::string printable_place(std::string_view text, std::size_t limit = 400);

}  // namespace pliant
