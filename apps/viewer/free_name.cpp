#include "viewer/free_name.h"

#include <algorithm>

#include <fmt/format.h>

namespace pliant_viewer {

namespace fs = std::filesystem;

fs::path free_name(const fs::path& folder, const std::string& scene, std::initializer_list<const char*> endings,
                   const std::string& what) {
  std::string base = fs::path(scene).filename().string();
  if (base.empty() || base == "." || base == "..") base = "scene";
  if (!what.empty()) base += "-" + what;
  for (int number = 1;; ++number) {
    const auto file = [&](const char* ending) { return folder / fmt::format("{}-{}{}", base, number, ending); };
    const auto is_taken = [&](const char* ending) { return fs::exists(fs::symlink_status(file(ending))); };
    if (std::ranges::none_of(endings, is_taken)) return file(*endings.begin());
  }
}

}  // namespace pliant_viewer
