#include "viewer/recent_files.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <string>

#include <nlohmann/json.hpp>

#include "pliant_io/files/atomic_file.h"
#include "pliant_io/files/read_file.h"

namespace pliant_viewer {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_files = 10;
constexpr std::uintmax_t most_bytes = 1 << 20;  // of the list
constexpr std::size_t most_remembered = 30;     // those on a disk that is away come back with it

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

std::vector<fs::path> read_all(const fs::path& list) {
  std::vector<fs::path> files;
  std::error_code ignored;
  if (const auto size = fs::file_size(list, ignored); ignored || size > most_bytes) return files;
  try {
    for (const auto& name : nlohmann::json::parse(pliant::read_file(list))) {
      if (name.is_string() && files.size() < most_remembered) files.emplace_back(name.get<std::string>());
    }
  } catch (const std::exception&) {
    files.clear();
  }
  return files;
}

}  // namespace

fs::path state_folder() {
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state != nullptr && fs::path(state).is_absolute()) return fs::path(state) / "pliant";
  const char* home = std::getenv("HOME");
  if (home == nullptr || !fs::path(home).is_absolute()) return {};
  return fs::path(home) / ".local" / "state" / "pliant";
}

fs::path recent_files_path() {
  const fs::path folder = state_folder();
  return folder.empty() ? folder : folder / "recent.json";
}

std::vector<fs::path> read_recent_files(const fs::path& list) {
  std::vector<fs::path> files = read_all(list);
  std::erase_if(files, [](const fs::path& file) { return !is_there(file); });
  files.resize(std::min(files.size(), most_files));
  return files;
}

void remember_file(const fs::path& list, const fs::path& file) {
  if (list.empty() || !is_there(file)) return;
  try {
    fs::path whole = fs::absolute(file).lexically_normal();  // a link stays one: a scene's meshes lie beside it
    if (!whole.has_filename()) whole = whole.parent_path();  // out/flag/
    std::vector<fs::path> files = read_all(list);
    std::erase(files, whole);
    files.insert(files.begin(), whole);
    nlohmann::json names = nlohmann::json::array();
    for (const fs::path& each : files) {
      if (names.size() < most_remembered) names.push_back(each.string());
    }
    fs::create_directories(list.parent_path());
    pliant::write_file_atomically(list, names.dump(1) + "\n");  // names that are not UTF-8 throw
  } catch (const std::exception&) {
    return;
  }
}

}  // namespace pliant_viewer
