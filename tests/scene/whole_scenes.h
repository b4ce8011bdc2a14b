#pragma once

#include <cstdlib>

namespace pliant_tests {

/// Built without optimization, for a sanitizer say, the scenes only make a start; so they do where PLIANT_SHORT_SCENES
/// is in the environment.
#ifdef NDEBUG
inline const bool runs_whole_scenes = std::getenv("PLIANT_SHORT_SCENES") == nullptr;
#else
inline constexpr bool runs_whole_scenes = false;
#endif

}  // namespace pliant_tests
