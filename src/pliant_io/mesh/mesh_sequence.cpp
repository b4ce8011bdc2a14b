#include "pliant_io/mesh/mesh_sequence.h"

#include <algorithm>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/mesh/mesh_file.h"

namespace pliant {
namespace {

constexpr std::size_t most_digits = 15;  // a double holds every such number

std::optional<std::int64_t> number_between(std::string_view name, std::string_view before, std::string_view behind) {
  if (name.size() <= before.size() + behind.size() || !name.starts_with(before) || !name.ends_with(behind)) return {};
  const std::string_view digits = name.substr(before.size(), name.size() - before.size() - behind.size());
  if (digits.size() > most_digits) return {};
  std::int64_t number = 0;
  for (const char c : digits) {
    if (c < '0' || c > '9') return {};
    number = 10 * number + (c - '0');
  }
  return number;
}

}  // namespace

bool is_mesh_sequence(const std::filesystem::path& pattern) {
  return pattern.filename().string().find('*') != std::string::npos;
}

std::vector<SequenceFile> sequence_files(const std::filesystem::path& pattern) {
  const std::string place = printable_place(pattern.string());
  const std::string name = pattern.filename().string();
  const std::size_t star = name.find('*');
  if (star == name.npos || name.find('*', star + 1) != name.npos) {
    fail_input(fmt::format("{}: a pattern has one star, in place of the number; give walk_*.obj, say", place));
  }
  const std::filesystem::path folder = pattern.parent_path().empty() ? "." : pattern.parent_path();
  std::error_code error;
  std::filesystem::directory_iterator entries(folder, error);
  if (error) fail_input(fmt::format("{}: the folder cannot be read: {}; correct the path", place, error.message()));
  const std::string_view before = std::string_view(name).substr(0, star);
  const std::string_view behind = std::string_view(name).substr(star + 1);
  std::vector<SequenceFile> files;
  for (const std::filesystem::directory_entry& entry : entries) {
    const std::string file = entry.path().filename().string();
    const std::optional<std::int64_t> number = number_between(file, before, behind);
    if (number) files.push_back({*number, pattern.parent_path() / file});
  }
  if (files.empty()) {
    fail_input(fmt::format("{}: no file has that name with a number in place of the star; correct the path", place));
  }
  std::ranges::sort(files, {}, [](const SequenceFile& file) { return std::pair(file.number, file.path); });
  const auto twice = std::ranges::adjacent_find(files, {}, &SequenceFile::number);
  if (twice != files.end()) {
    fail_input(fmt::format("{}: {} and {} have one number; remove one of them", place,
                           printable_place(twice->path.filename().string()),
                           printable_place((twice + 1)->path.filename().string())));
  }
  return files;
}

PointCache read_mesh_sequence(const std::vector<SequenceFile>& files, const PointCacheOptions& options) {
  check_frame_rate(options);
  std::vector<Positions> frames;
  std::vector<Real> times;
  for (const SequenceFile& file : files) {
    frames.push_back(read_mesh(file.path).vertices);
    if (frames.back().rows() != frames.front().rows()) {
      fail_input(fmt::format("{}: {} vertices, but {} has {}; give all frames the same vertices",
                             printable_place(file.path.string()), frames.back().rows(),
                             printable_place(files.front().path.string()), frames.front().rows()));
    }
    times.push_back(static_cast<Real>(file.number - files.front().number) / options.frames_per_second);
  }
  return PointCache::from_frames(frames, std::move(times));
}

}  // namespace pliant
