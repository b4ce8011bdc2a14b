#include "sweep/sweep_plan.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant/core/version.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/files/read_file.h"
#include "system/folder_lock.h"

namespace pliant_sweep {
namespace {

namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;

constexpr std::string_view plan_name = "sweep.json";
constexpr std::string_view table_name = "sweep.csv";
constexpr std::string_view page_name = "index.html";
constexpr std::string_view runs_name = "runs";
constexpr std::string_view plots_name = "plots";
constexpr std::string_view format_name = "sweep";

[[noreturn]] void fail_output(const fs::path& path, std::string_view what) {
  throw pliant::Error(pliant::ErrorKind::output, fmt::format("{}: {}", pliant::printable_place(path.string()), what));
}

// ---- to sweep.json and back

OrderedJson texts_json(const std::vector<TextStamp>& texts) {
  OrderedJson list = OrderedJson::array();
  for (const TextStamp& text : texts) list.push_back({{"file", text.file.string()}, {"crc32", text.crc32}});
  return list;
}

OrderedJson plan_json(const SweepPlan& plan) {
  const SweepSetup& setup = plan.setup;
  std::map<std::string, std::uint32_t> files = setup.files;
  files.insert(plan.other_files.begin(), plan.other_files.end());
  OrderedJson json = {{"pliant_file", format_name},
                      {"pliant", pliant::version},
                      {"scene", setup.scene},
                      {"texts", texts_json(setup.texts)},
                      {"files", files},
                      {"set", setup.set},
                      {"options", OrderedJson::object()},
                      {"vary", OrderedJson::array()},
                      {"runs", OrderedJson::array()}};
  for (const auto& [name, value] : setup.options) json["options"][name] = value;
  for (const Variation& each : setup.variations) {
    json["vary"].push_back({{"path", each.path}, {"values", each.values}});
  }
  for (const auto* runs : {&plan.runs, &plan.others}) {
    for (const SweepRun& run : *runs) json["runs"].push_back({{"name", run.name}, {"values", run.values}});
  }
  return json;
}

struct EarlierPlan {
  std::string version;
  SweepSetup setup;
  std::vector<SweepRun> runs;
};

bool is_run_name(const std::string& name) {
  return !name.empty() && name.size() < 10 && name.find_first_not_of("0123456789") == name.npos;
}

[[noreturn]] void fail_json(const std::string& what) {
  throw OrderedJson::other_error::create(501, what, nullptr);
}

std::uint32_t crc32_of(const OrderedJson& json) {
  const bool is_ours = json.is_number_unsigned() && json.get<std::uint64_t>() <= 0xFFFF'FFFFU;
  if (!is_ours) fail_json("a CRC-32 that is none");
  return json.get<std::uint32_t>();
}

/// @throws OrderedJson::exception
EarlierPlan earlier_of(const OrderedJson& json) {
  EarlierPlan earlier;
  if (json.at("pliant_file") != format_name) fail_json("not of a sweep");
  earlier.version = json.at("pliant").get<std::string>();
  for (const OrderedJson& text : json.at("texts")) {
    earlier.setup.texts.push_back({text.at("file").get<std::string>(), crc32_of(text.at("crc32"))});
  }
  for (const auto& [path, crc32] : json.at("files").items()) earlier.setup.files.emplace(path, crc32_of(crc32));
  json.at("set").get_to(earlier.setup.set);
  for (const auto& [name, value] : json.at("options").items()) {
    earlier.setup.options.emplace_back(name, value.get<std::string>());
  }
  for (const OrderedJson& each : json.at("vary")) {
    earlier.setup.variations.push_back({each.at("path").get<std::string>(), {}});
  }
  std::set<std::string> names;
  for (const OrderedJson& each : json.at("runs")) {
    SweepRun run{each.at("values").get<Combination>(), each.at("name").get<std::string>()};
    const bool is_ours = is_run_name(run.name) && run.values.size() == earlier.setup.variations.size();
    if (!is_ours) fail_json("a run without its values");
    if (!names.insert(run.name).second) fail_json(fmt::format("the run {} twice", run.name));
    earlier.runs.push_back(std::move(run));
  }
  return earlier;
}

std::optional<EarlierPlan> read_earlier_plan(const fs::path& folder) {
  std::error_code ignored;
  const fs::path file = folder / plan_name;
  if (!fs::exists(file, ignored)) {
    for (const std::string_view name : {runs_name, plots_name, table_name, page_name}) {
      if (!fs::exists(folder / name, ignored)) continue;
      fail_output(folder / name, "would be replaced, and no sweep wrote it; choose another folder");
    }
    return std::nullopt;
  }
  std::string why;
  try {
    return earlier_of(OrderedJson::parse(pliant::read_file(file)));
  } catch (const OrderedJson::exception& error) {
    why = pliant::printable(error.what());
  }
  fail_output(file, fmt::format("was not written by a sweep ({}); choose another folder", why));
}

// ---- what can be compared

std::string set_text(const std::vector<std::string>& set) {
  return set.empty() ? "no --set" : fmt::format("--set {}", fmt::join(set, " --set "));
}

std::string options_text(const SweepSetup& setup) {
  std::string text;
  for (const auto& [name, value] : setup.options) text += fmt::format("{}{} {}", text.empty() ? "" : " ", name, value);
  return text.empty() ? "no options" : text;
}

std::vector<std::string> sorted_paths(const SweepSetup& setup) {
  std::vector<std::string> paths;
  for (const Variation& each : setup.variations) paths.push_back(each.path);
  std::ranges::sort(paths);
  return paths;
}

/// Why the runs of an earlier start cannot stand beside those of this one; empty: they can.
std::string difference(const EarlierPlan& earlier, const SweepSetup& now) {
  const SweepSetup& then = earlier.setup;
  if (earlier.version != pliant::version) return fmt::format("were made by Pliant {}", earlier.version);
  if (!std::ranges::equal(then.texts, now.texts, {}, &TextStamp::crc32, &TextStamp::crc32)) {
    return "are of a scene with another text";
  }
  for (const auto& [path, crc32] : now.files) {
    const auto found = then.files.find(path);
    if (found != then.files.end() && found->second != crc32) return fmt::format("are of another {}", path);
  }
  if (then.set != now.set) return fmt::format("have {} rather than {}", set_text(then.set), set_text(now.set));
  if (then.options != now.options) {
    return fmt::format("have {} rather than {}", options_text(then), options_text(now));
  }
  if (sorted_paths(then) != sorted_paths(now)) {
    return fmt::format("vary {} rather than {}", fmt::join(sorted_paths(then), " and "),
                       fmt::join(sorted_paths(now), " and "));
  }
  return "";
}

// ---- links

/// A folder from elsewhere may hold links, through which files of other folders would be replaced or removed.
void refuse_link(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_symlink(path, ignored)) return;
  fail_output(path, "cannot be written: it is a link to another place; remove the link, or choose another folder");
}

/// Logs are made anew and runs look after their own files; all else that a sweep writes is looked at here.
void refuse_links(const fs::path& folder, const SweepPlan& plan) {
  for (const std::string_view name : {plan_name, table_name, page_name, runs_name, plots_name}) {
    refuse_link(folder / name);
  }
  for (const SweepRun& run : plan.runs) refuse_link(run_folder(folder, run.name));
  std::error_code error;
  for (fs::directory_iterator entry(folder / plots_name, error), end; !error && entry != end; entry.increment(error)) {
    refuse_link(entry->path());
  }
}

// ---- the plan

/// Recognizes a combination, in whatever order its paths come and however its values are written.
std::string key_of(const std::vector<Variation>& variations, const Combination& values) {
  nlohmann::json key = nlohmann::json::object();
  for (std::size_t i = 0; i < values.size(); ++i) key[variations[i].path] = canonical_value(values[i]);
  return key.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

int number_of_run(const std::string& name) {
  int number = 0;
  std::from_chars(name.data(), name.data() + name.size(), number);
  return number;
}

/// The values of an earlier run, in the order of the paths of now.
Combination reordered(const SweepSetup& then, const SweepSetup& now, const Combination& values) {
  Combination result;
  for (const Variation& variation : now.variations) {
    const auto place = std::ranges::find(then.variations, variation.path, &Variation::path) - then.variations.begin();
    result.push_back(values[static_cast<std::size_t>(place)]);
  }
  return result;
}

/// Gives combinations that an earlier start had their runs, and keeps the other runs.
void take_over(SweepPlan& plan, const EarlierPlan& earlier, const fs::path& folder) {
  std::map<std::string, const SweepRun*> known;
  for (const SweepRun& run : earlier.runs) known.emplace(key_of(earlier.setup.variations, run.values), &run);
  for (SweepRun& run : plan.runs) {
    const auto found = known.find(key_of(plan.setup.variations, run.values));
    if (found == known.end()) continue;
    run.name = found->second->name;
    run.result = read_run_result(run_folder(folder, run.name));
    known.erase(found);
  }
  for (const auto& [key, run] : known) {
    plan.others.push_back({reordered(earlier.setup, plan.setup, run->values), run->name});
  }
  for (const auto& [path, crc32] : earlier.setup.files) {
    if (!plan.setup.files.contains(path)) plan.other_files.emplace(path, crc32);
  }
}

}  // namespace

std::size_t count_of(const SweepPlan& plan, RunOutcome outcome) {
  return static_cast<std::size_t>(
      std::ranges::count_if(plan.runs, [&](const SweepRun& run) { return run.result.outcome == outcome; }));
}

std::string outcomes_text(const SweepPlan& plan) {
  std::string text;
  const auto names = choice_names(RunOutcome{});
  for (const RunOutcome outcome : {RunOutcome::ok, RunOutcome::diverged, RunOutcome::failed, RunOutcome::waiting}) {
    const std::size_t count = count_of(plan, outcome);
    if (count == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, names[static_cast<std::size_t>(outcome)]);
  }
  return text;
}

bool has_sweep(const fs::path& folder) {
  std::error_code ignored;
  return fs::exists(folder / plan_name, ignored);
}

fs::path run_folder(const fs::path& folder, const std::string& name) {
  return folder / runs_name / name;
}

fs::path run_log(const fs::path& folder, const std::string& name) {
  return folder / runs_name / (name + ".log");
}

SweepPlan plan_sweep(const fs::path& folder, SweepSetup setup, Earlier earlier) {
  SweepPlan plan{std::move(setup), {}, {}, {}};
  for (Combination& values : product_of(plan.setup.variations)) plan.runs.push_back({std::move(values), ""});
  int last = 0;
  if (const auto there = read_earlier_plan(folder); there && earlier == Earlier::remove) {
    for (const SweepRun& run : there->runs) plan.removed.push_back(run.name);
  } else if (there) {
    const std::string what = difference(*there, plan.setup);
    if (!what.empty()) {
      pliant::fail_input(
          fmt::format("{}: the runs there {}, so that these could not be compared with them; give "
                      "another folder, or begin anew with --restart",
                      pliant::printable_place(folder.string()), pliant::printable(what, 400)));
    }
    take_over(plan, *there, folder);
    for (const SweepRun& run : there->runs) last = std::max(last, number_of_run(run.name));
  }
  for (SweepRun& run : plan.runs) {
    if (run.name.empty()) run.name = fmt::format("{:04}", ++last);
  }
  return plan;
}

void begin_sweep(const fs::path& folder, const SweepPlan& plan) {
  refuse_links(folder, plan);
  std::error_code error;
  const auto check = [&error](const fs::path& path, std::string_view what) {
    if (error) fail_output(path, fmt::format("{}: {}; choose another folder", what, error.message()));
  };
  for (const std::string& name : plan.removed) {  // one that a command of --list has started may be at work
    if (fs::is_directory(run_folder(folder, name), error)) pliant_system::FolderLock(run_folder(folder, name));
  }
  for (const std::string& name : plan.removed) {
    for (const fs::path& path : {run_folder(folder, name), run_log(folder, name)}) {
      fs::remove_all(path, error);
      check(path, "cannot be removed");
    }
  }
  const std::string text = plan_json(plan).dump(2, ' ', false, OrderedJson::error_handler_t::replace) + '\n';
  pliant::write_file_atomically(folder / plan_name, text);
  fs::create_directories(folder / runs_name, error);
  check(folder / runs_name, "cannot be made");
}

}  // namespace pliant_sweep
