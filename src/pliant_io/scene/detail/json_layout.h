#pragma once
// JSON laid out for people.
#include <string>

#include "pliant_io/scene/detail/json_text.h"

namespace pliant {

/// A value with each key on a line of its own, except that what is short stands in one line, as a vector does, and that
/// long lists of numbers fill their lines. Ends without a line break.
/// @throws Error (input) on a text that is not UTF-8.
std::string lay_out(const SceneJson& json);

}  // namespace pliant
