#pragma once
#include <string>
#include <string_view>

namespace pliant {

/// A field of a CSV file (RFC 4180, Sec. 2): in quotes where it has commas, quotes or line ends.
std::string csv_field(std::string_view text);

}  // namespace pliant
