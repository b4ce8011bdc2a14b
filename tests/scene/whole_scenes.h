#pragma once

namespace pliant_tests {

/// Built without optimization, for a sanitizer say, the scenes only make a start.
#ifdef NDEBUG
inline constexpr bool runs_whole_scenes = true;
#else
inline constexpr bool runs_whole_scenes = false;
#endif

}  // namespace pliant_tests
