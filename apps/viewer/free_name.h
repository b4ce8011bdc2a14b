#pragma once
// Names for files that the window saves.
#include <filesystem>
#include <initializer_list>
#include <string>

namespace pliant_viewer {

/// The next free name like "sheet-1.json", or "sheet-plot-1.svg" with `what`, for files with these endings; it has the
/// first of them.
std::filesystem::path free_name(const std::filesystem::path& folder, const std::string& scene,
                                std::initializer_list<const char*> endings, const std::string& what = {});

}  // namespace pliant_viewer
