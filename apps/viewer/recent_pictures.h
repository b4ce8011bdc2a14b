#pragma once
// Small pictures of what was shown in the window, for its list of scenes: PNG files in `pictures` of
// $XDG_CACHE_HOME/pliant, or ~/.cache/pliant. A convenience: what cannot be read or written is passed over.
#include <filesystem>
#include <optional>

#include "render/image.h"

namespace pliant_viewer {

/// Of each picture [pixels].
constexpr int recent_picture_width = 256, recent_picture_height = 160;
/// How many are kept, those written last.
constexpr std::size_t most_recent_pictures = 30;

/// Where they are kept; empty where the environment names no folder.
std::filesystem::path recent_pictures_folder();
/// The file with the picture of a scene, mesh, session or run, there or not; empty where the folder is.
std::filesystem::path recent_picture_file(const std::filesystem::path& folder, const std::filesystem::path& shown);

/// Writes the picture of a file or folder that exists, and removes the oldest beyond those that are kept.
void keep_recent_picture(const std::filesystem::path& folder, const std::filesystem::path& shown,
                         const pliant_render::Image& picture);
/// Of a PNG file; none where it is no picture.
std::optional<pliant_render::Image> read_recent_picture(const std::filesystem::path& file);

/// The mean of two by two pixels each. @throws std::logic_error for an image that is not whole.
pliant_render::Image halved(const pliant_render::Image& image);

}  // namespace pliant_viewer
