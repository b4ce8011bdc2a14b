#pragma once
#include <string>
#include <string_view>

namespace pliant {

/// The bytes as text of the 64 digits of RFC 4648, Sec. 4, with its padding and without line breaks.
std::string base64(std::string_view bytes);

}  // namespace pliant
