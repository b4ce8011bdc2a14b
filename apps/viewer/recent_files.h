#pragma once
// The files that were opened in the window, for its list of scenes: names of files, newest first, in `recent.json` of
// $XDG_STATE_HOME/pliant, or ~/.local/state/pliant. A convenience: what cannot be read or written is passed over.
#include <filesystem>
#include <vector>

namespace pliant_viewer {

/// Where the window keeps what it remembers, $XDG_STATE_HOME/pliant or ~/.local/state/pliant; empty where the
/// environment names no folder.
std::filesystem::path state_folder();

/// Where the list is kept; empty where the environment names no folder.
std::filesystem::path recent_files_path();

/// Those of the list that still exist, newest first, at most ten.
std::vector<std::filesystem::path> read_recent_files(const std::filesystem::path& list);

/// Puts a file or folder, made absolute, at the head of the list. What does not exist is not taken: a built-in scene.
void remember_file(const std::filesystem::path& list, const std::filesystem::path& file);

}  // namespace pliant_viewer
