#pragma once
// The files of a run, all in one folder: run.json, measurements.csv and, unless the format of its frames is "none",
// mesh.obj and the frames.
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pliant {

/// From which a run goes on.
inline constexpr std::string_view checkpoint_name = "checkpoint.pliant";

/// Where the frames of a format are: frames.npy, frames.pc2, frame_*.obj or frame_*.ply; "" for "none".
std::string frames_name(std::string_view format);

/// frame_00012.obj for frame 12, the extension being the format's name.
std::string frame_file_name(std::int64_t frame, std::string_view format);

/// The names of all files of a run with frames of a format; a star stands for the numbers of frames.
std::vector<std::string> run_files(std::string_view format);

/// Whether a file of this name in the folder of a run is one that a run writes, whatever its format.
bool is_run_file(std::string_view file);

/// Makes the folder where it is missing. @throws Error (output): the name stands for something else, or it cannot be
/// made.
void make_run_folder(const std::filesystem::path& folder);

/// The files in a folder that a run with frames of a format would remove or replace. Does not throw.
std::vector<std::filesystem::path> replaced_files(const std::filesystem::path& folder, std::string_view format);

/// Whether a run begins in a folder, or goes on with files that are there.
enum class RunStart { anew, resumed };

/// Refuses a folder where a name that the run writes is a link, so that a file elsewhere would be written: a symbolic
/// link of any of them; for a run that goes on also a second name of a file that grows in place.
/// @throws Error (output), naming the link
void refuse_links(const std::filesystem::path& folder, std::string_view format, RunStart start);

/// Makes the folder where it is missing, and removes the files that the run.json there tells an earlier run wrote, with
/// what killed runs left half-written (remove_leftovers). Everything else stays, and nothing of it is replaced:
/// @throws Error (output): the name stands for something else, the folder cannot be used, a file stands there that this
///   run would replace and no earlier one wrote, or a link (refuse_links).
void prepare_run_folder(const std::filesystem::path& folder, std::string_view format);

}  // namespace pliant
