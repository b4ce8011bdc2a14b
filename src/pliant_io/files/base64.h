#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace pliant {

/// The bytes as text of the 64 digits of RFC 4648, Sec. 4, with its padding and without line breaks.
std::string base64(std::string_view bytes);

/// The bytes of such a text; none: it is not one.
std::optional<std::string> bytes_of_base64(std::string_view text);

}  // namespace pliant
