#pragma once
#include <string>

namespace pliant {

/// The JSON Schema (draft 2020-12) of scene files, made from the lists of options that also read them: what it accepts
/// has the right keys and types. Whether names and vertices exist only the program knows.
std::string scene_schema();

}  // namespace pliant
