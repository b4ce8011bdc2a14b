#include "pliant_io/recorder/detail/run_json.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pliant/core/error.h"
#include "pliant_io/files/number_text.h"
#include "pliant_io/files/read_file.h"
#include "pliant_io/recorder/run_files.h"

namespace pliant {
namespace {

using Json = nlohmann::json;

/// A value of run.json with the place that messages give it.
struct Node {
  const Json& json;
  std::string place;

  [[noreturn]] void fail(std::string_view what) const {
    fail_input(fmt::format("{}: {}; give the folder of a run as `pliant run` left it", place, what));
  }

  Node at(const char* key) const {
    if (!json.is_object()) fail("is not an object");
    const auto found = json.find(key);
    if (found == json.end()) fail(fmt::format("has no \"{}\"", key));
    return {*found, fmt::format("{}: {}", place, key)};
  }

  std::string text() const {
    if (!json.is_string()) fail("is not a text");
    return json.get<std::string>();
  }

  std::int64_t count() const {
    const bool fits =
        json.is_number_integer() && (!json.is_number_unsigned() || json.get<std::uint64_t>() < (1ULL << 62));
    if (!fits || json.get<std::int64_t>() < 0) fail("is not a count");
    return json.get<std::int64_t>();
  }

  Real positive() const {
    if (!json.is_number() || !std::isfinite(json.get<Real>()) || json.get<Real>() <= 0)
      fail("is not a positive number");
    return json.get<Real>();
  }

  /// Calls `read` with one item after the other.
  template <typename Read>
  void for_each(const Read& read) const {
    if (!json.is_array()) fail("is not a list");
    for (std::size_t i = 0; i < json.size(); ++i) read(Node{json[i], fmt::format("{}[{}]", place, i)});
  }
};

std::vector<BodyRange> read_bodies(const Node& list) {
  std::vector<BodyRange> bodies;
  std::int64_t next = 0;
  list.for_each([&](const Node& node) {
    const std::int64_t first = node.at("first_vertex").count();
    const std::int64_t count = node.at("vertices").count();
    if (first != next) node.fail("does not begin where the body before it ends");
    if (count > std::numeric_limits<Index>::max() - first) node.fail("has too many vertices");
    bodies.push_back({node.at("name").text(), static_cast<Index>(first), static_cast<Index>(count)});
    next = first + count;
  });
  return bodies;
}

/// Values of a run's own file are longer than these, with their keys and blanks; a file of shorter ones would cost many
/// times its size of memory.
constexpr std::ptrdiff_t min_bytes_per_value = 12;
constexpr std::ptrdiff_t always_allowed_values = 1000;

void refuse_too_many_values(std::string_view bytes, const std::string& name) {
  const auto begins_value = [](char c) { return c == ',' || c == '[' || c == '{'; };
  if (std::ranges::count_if(bytes, begins_value) <= always_allowed_values + std::ssize(bytes) / min_bytes_per_value) {
    return;
  }
  fail_input(
      fmt::format("{}: holds more values than a run writes; give the folder of a run as `pliant run` left it", name));
}

Json parse_json(const std::string& bytes, const std::string& name) {
  refuse_too_many_values(bytes, name);
  Json json = Json::parse(bytes, nullptr, false);
  if (!json.is_discarded()) return json;
  fail_input(fmt::format("{}: is not JSON; give the folder of a run as `pliant run` left it", name));
}

/// The field of a line of a CSV file whose columns before it hold no commas.
std::string_view field(std::string_view line, std::size_t column) {
  for (std::size_t i = 0; i < column; ++i) line.remove_prefix(std::min(line.find(',') + 1, line.size()));
  return line.substr(0, line.find(','));
}

}  // namespace

EarlierRun read_earlier_run(const std::filesystem::path& path) {
  const Json json = parse_json(read_file(path), path.string());
  const Node root = {json, path.string()};
  EarlierRun run;
  run.scene = root.at("scene").text();
  const Node output = root.at("output");
  run.format = output.at("format").text();
  if (output.json.contains("files")) {
    output.at("files").for_each([&](const Node& file) { run.files.push_back(file.text()); });
  } else {
    run.files = {"measurements.csv", frames_name(run.format)};  // version 0.1.0
  }
  if (root.at("outcome").text() != "running") {
    const Node totals = root.at("totals");
    run.frame_count = totals.at("frames").count();
    const bool has_checksum = totals.json.contains("last_frame_crc32");
    if (has_checksum) run.last_frame = static_cast<std::uint32_t>(totals.at("last_frame_crc32").count());
  }
  run.seconds_per_frame =
      root.at("settings").at("time_step").positive() * static_cast<Real>(output.at("every").count());
  run.bodies = read_bodies(root.at("bodies"));
  return run;
}

std::vector<Real> read_frame_times(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return {};
  const std::string text = read_file(path);
  constexpr std::string_view names = "step,time,";
  constexpr std::size_t time_column = 1;
  if (!text.starts_with(names))
    fail_input(fmt::format("{}:1: does not begin with \"{}\"; run the scene again", path.string(), names));
  std::vector<Real> times;
  // A last line without its end is one that a killed run was writing.
  for (std::size_t begin = text.find('\n') + 1, end = 0; begin > 0 && (end = text.find('\n', begin)) != text.npos;
       begin = end + 1) {
    const std::string_view word = field(std::string_view(text).substr(begin, end - begin), time_column);
    Real time = 0;
    const auto [rest, error] = number_from_chars(word.data(), word.data() + word.size(), time);
    const bool is_time = error == std::errc() && rest == word.data() + word.size() && std::isfinite(time);
    if (!is_time || (!times.empty() && time <= times.back())) {
      fail_input(fmt::format("{}:{}: has no time after that of the line before; run the scene again", path.string(),
                             times.size() + 2));
    }
    times.push_back(time);
  }
  return times;
}

}  // namespace pliant
