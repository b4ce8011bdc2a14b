#include "pliant_io/recorder/run_files.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/recorder/detail/run_json.h"

namespace pliant {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view star = "*";

[[noreturn]] void fail_output(const fs::path& path, std::string_view what) {
  throw Error(ErrorKind::output, fmt::format("{}: cannot be used for the files of a run: {}; choose another folder",
                                             printable_place(path.string()), what));
}

/// Every name that a run may have written, in this version or an earlier one.
constexpr std::array known_names = {"run.json",   "measurements.csv", "checkpoint.pliant", "mesh.obj",
                                    "frames.npy", "frames.pc2",       "frame_*.obj",       "frame_*.ply"};

bool is_known(std::string_view name) {
  return std::ranges::find(known_names, name) != known_names.end();
}

/// The number of a frame's file; none for a file of another name.
std::optional<std::int64_t> frame_number(std::string_view file, std::string_view pattern) {
  const std::size_t place = pattern.find(star);
  const std::string_view head = pattern.substr(0, place);
  const std::string_view tail = pattern.substr(place + star.size());
  constexpr std::size_t least_digits = 5;
  if (file.size() < head.size() + least_digits + tail.size() || !file.starts_with(head) || !file.ends_with(tail)) {
    return {};
  }
  const std::string_view digits = file.substr(head.size(), file.size() - head.size() - tail.size());
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool is_number = error == std::errc() && end == digits.data() + digits.size() && digits.front() != '-';
  return is_number ? std::optional(number) : std::nullopt;
}

bool is_pattern(std::string_view name) {
  return name.find(star) != name.npos;
}

/// Whether a name, or a pattern of names, is that of the file.
bool is_name_of(std::string_view name, std::string_view file) {
  return is_pattern(name) ? frame_number(file, name).has_value() : file == name;
}

/// Whether a file has one of these names or patterns.
bool is_among(const std::vector<std::string>& names, std::string_view file) {
  return std::ranges::any_of(names, [&](const std::string& name) { return is_name_of(name, file); });
}

/// Files that a run which goes on opens and writes in; the others are replaced as a whole.
bool grows_in_place(std::string_view file) {
  return file == "measurements.csv" || file == frames_name("npy") || file == frames_name("pc2");
}

[[noreturn]] void fail_link(const fs::path& path, std::string_view what) {
  throw Error(ErrorKind::output, fmt::format("{}: cannot be written: {}", printable_place(path.string()), what));
}

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    // What else has the name of a file of ours is refused where that is to be written.
    if (entry->is_regular_file(ignored)) names.insert(entry->path().filename().string());
  }
  if (error) fail_output(folder, error.message());
  return names;
}

/// Frames 0, 1, ... as far as the run counted them; a run that was killed could not, but left no gap.
void add_frames(std::set<std::string>& files, const std::set<std::string>& names, std::string_view pattern,
                std::optional<std::int64_t> frame_count) {
  std::map<std::int64_t, std::string> frames;
  for (const std::string& name : names) {
    if (const auto number = frame_number(name, pattern)) frames.emplace(*number, name);
  }
  std::int64_t next = 0;
  for (const auto& [number, name] : frames) {
    if (frame_count ? number >= *frame_count : number != next) return;
    files.insert(name);
    ++next;
  }
}

/// What a killed run of version 0.1.0 was writing, of a file of that name.
bool is_temporary_of(std::string_view name, std::string_view file) {
  const std::size_t end = file.rfind(".tmp-");
  return end != file.npos && is_name_of(name, file.substr(0, end));
}

/// The files among `names` that an earlier run wrote, but for run.json: that one is replaced at once, and tells of the
/// others until then.
std::set<std::string> files_of_earlier_run(const fs::path& folder, const std::set<std::string>& names) {
  std::set<std::string> files;
  if (!names.contains("run.json")) return files;
  EarlierRun earlier;
  try {
    earlier = read_earlier_run(folder / "run.json");
  } catch (const Error& error) {
    fail_output(folder, fmt::format("its run.json was not written by a run ({})", error.what()));
  }
  for (const std::string& name : earlier.files) {
    if (!is_known(name)) continue;
    std::ranges::copy_if(names, std::inserter(files, files.end()),
                         [&](const std::string& file) { return is_temporary_of(name, file); });
    if (name == "run.json") continue;
    if (is_pattern(name)) {
      add_frames(files, names, name, earlier.frame_count);
    } else if (names.contains(name)) {
      files.insert(name);
    }
  }
  return files;
}

}  // namespace

std::string frames_name(std::string_view format) {
  if (format == "none") return "";
  const bool is_one_file = format == "npy" || format == "pc2";
  return fmt::format("{}.{}", is_one_file ? "frames" : "frame_*", format);
}

std::string frame_file_name(std::int64_t frame, std::string_view format) {
  return fmt::format("frame_{:05}.{}", frame, format);
}

std::vector<std::string> run_files(std::string_view format) {
  std::vector<std::string> names = {"run.json", "measurements.csv", std::string(checkpoint_name)};
  if (format != "none") names.insert(names.begin(), {frames_name(format), "mesh.obj"});
  return names;
}

bool is_run_file(std::string_view file) {
  return std::ranges::any_of(known_names, [&](std::string_view name) { return is_name_of(name, file); });
}

void make_run_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail_output(folder, error.message());
}

std::vector<fs::path> replaced_files(const fs::path& folder, std::string_view format) {
  const std::vector<std::string> wanted = run_files(format);
  std::vector<fs::path> files;
  try {
    const std::set<std::string> names = names_in(folder);
    for (const std::string& file : names) {
      if (is_among(wanted, file)) files.push_back(folder / file);
    }
    for (const std::string& file : files_of_earlier_run(folder, names)) files.push_back(folder / file);
  } catch (const Error&) {  // of a folder that is not there or is of no run; prepare_run_folder() tells
  }
  return files;
}

void refuse_links(const fs::path& folder, std::string_view format, RunStart start) {
  const std::vector<std::string> names = run_files(format);
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string file = entry->path().filename().string();
    std::error_code ignored;
    if (!is_among(names, file)) continue;
    if (entry->is_symlink(ignored)) {
      fail_link(entry->path(), "it is a link to another place; remove the link, or choose another folder");
    }
    if (start == RunStart::resumed && grows_in_place(file) && entry->hard_link_count(ignored) > 1) {
      fail_link(entry->path(),
                "the file has another name as well (a hard link), under which it would change too; "
                "put a copy in its place");
    }
  }
}

void prepare_run_folder(const fs::path& folder, std::string_view format) {
  make_run_folder(folder);
  refuse_links(folder, format, RunStart::anew);
  remove_leftovers(folder, is_run_file);
  const std::set<std::string> names = names_in(folder);
  const std::set<std::string> earlier = files_of_earlier_run(folder, names);
  const std::vector<std::string> wanted = run_files(format);
  for (const std::string& file : names) {
    if (file == "run.json" || earlier.contains(file) || !is_among(wanted, file)) continue;
    fail_output(folder, fmt::format("the run would replace its {}, which no run wrote", file));
  }
  // The last frames first: a run that is killed here leaves no gap, behind which the next one would not know them.
  std::vector<std::string> last_first(earlier.begin(), earlier.end());
  std::ranges::sort(last_first, std::ranges::greater(), [](const std::string& file) {
    return std::pair<std::size_t, std::string_view>(file.size(), file);
  });
  for (const std::string& file : last_first) {
    std::error_code error;
    fs::remove(folder / file, error);
    if (error) fail_output(folder / file, error.message());
  }
}

}  // namespace pliant
