#pragma once
// What the fuzz targets share: any bytes may end in pliant::Error, in nothing else.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <string_view>

#include "pliant/core/error.h"

namespace pliant_fuzz {

inline std::string_view text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Ends the program with a report when a promise is broken.
inline void require(bool holds, const char* broken) {
  if (holds) return;
  std::fprintf(stderr, "fuzz: %s\n", broken);
  std::abort();
}

/// Where the files are that scenes of the seeds refer to.
inline std::filesystem::path scene_folder() {
  return std::filesystem::path(PLIANT_SOURCE_DIR) / "fuzz" / "seeds" / "fuzz_scene";
}

/// Calls f; an Error must be one line. Anything else that is thrown ends the program.
template <class F>
void expect_errors_only(F&& f) {
  try {
    f();
  } catch (const pliant::Error& error) {
    const std::string_view message = error.what();
    require(!message.empty() && message.find('\n') == message.npos, "an error is not one line");
    require(message.size() < 2000, "an error is longer than anyone reads");
  }
}

}  // namespace pliant_fuzz
