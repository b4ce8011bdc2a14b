#pragma once
// zlib's format (RFC 1950) in memory.
#include <span>
#include <string>
#include <string_view>

namespace pliant {

/// The bytes compressed, the same for the same bytes.
std::string compressed(std::string_view bytes);

/// Fills `into` with what was compressed. Whether it was neither less nor more, and whole.
bool uncompress_into(std::string_view bytes, std::span<char> into);

}  // namespace pliant
