#include "sweep/sweep_setup.h"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/files/crc32.h"
#include "pliant_io/files/read_file.h"

namespace pliant_sweep {
namespace {

using pliant::SceneOverrides;

constexpr std::string_view threads_path = "settings.threads";

/// An option of `pliant run` that takes the place of a value of the scene.
struct RunOption {
  std::string_view name;
  std::string_view path;
  std::optional<std::string> value;
};

template <class Number>
std::optional<std::string> number_text(const std::optional<Number>& number) {
  return number ? std::optional(fmt::format("{}", *number)) : std::nullopt;
}

template <class Choice>
std::optional<std::string> choice_text(const std::optional<Choice>& choice) {
  if (!choice) return std::nullopt;
  return std::string(choice_names(*choice)[static_cast<std::size_t>(*choice)]);
}

/// All but threads. The names are bound to all members, so that one that is added is not forgotten here.
auto options_of(const SceneOverrides& overrides) {
  const auto& [steps, time_step, iterations, tolerance, threads, backend, format, every, set] = overrides;
  static_cast<void>(threads);
  static_cast<void>(set);
  return std::array{RunOption{"--steps", "steps", number_text(steps)},
                    RunOption{"--time-step", "settings.time_step", number_text(time_step)},
                    RunOption{"--iterations", "settings.iterations", number_text(iterations)},
                    RunOption{"--tolerance", "settings.tolerance", number_text(tolerance)},
                    RunOption{"--backend", "settings.backend", choice_text(backend)},
                    RunOption{"--format", "output.format", choice_text(format)},
                    RunOption{"--every", "output.every", number_text(every)}};
}

/// A value that all runs have cannot be varied: one of the two would count for nothing.
void check_variation(const Variation& variation, const SceneOverrides& overrides) {
  const std::string place = fmt::format("--vary {}", pliant::printable(variation.path));
  for (const RunOption& option : options_of(overrides)) {
    if (variation.path != option.path || !option.value) continue;
    pliant::fail_input(
        fmt::format("{}: {} sets the same value for all runs; leave out one of the two", place, option.name));
  }
  if (variation.path == threads_path && overrides.threads) {
    pliant::fail_input(fmt::format("{}: --threads sets the same value for all runs; leave out one of the two", place));
  }
  for (const std::string& assignment : overrides.set) {
    if (!assignment.starts_with(variation.path + "=")) continue;
    pliant::fail_input(fmt::format("{}: --set sets the same value for all runs; leave out one of the two", place));
  }
}

std::vector<std::string> assignments(const std::vector<Variation>& variations, const Combination& values) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < values.size(); ++i) {
    texts.push_back(fmt::format("{}={}", variations[i].path, values[i]));
  }
  return texts;
}

/// The scene of a combination. Errors of a value that is varied name the option that it comes from.
pliant::Scene open_combination(const SweepOptions& options, const OpenScene& open_scene, const Combination& values) {
  SceneOverrides overrides = options.overrides;
  const std::vector<std::string> varied = assignments(options.variations, values);
  overrides.set.insert(overrides.set.end(), varied.begin(), varied.end());
  try {
    return open_scene(overrides);
  } catch (const pliant::Error& error) {
    std::string message = error.what();
    constexpr std::string_view head = "--set ";
    for (const Variation& variation : options.variations) {
      if (!message.starts_with(fmt::format("{}{}=", head, variation.path))) continue;
      message = fmt::format("--vary {}", std::string_view(message).substr(head.size()));
      break;
    }
    throw pliant::Error(error.kind(), message);
  }
}

std::string_view path_of(std::string_view assignment) {
  return assignment.substr(0, assignment.find('='));
}

/// The keys of a path alone: the lists that it goes through, whatever their entries are called there.
std::string keys_of(std::string_view path) {
  std::string keys;
  bool is_entry = false;
  for (const char c : path) {
    is_entry = c == '[' || (is_entry && c != ']');
    if (!is_entry && c != ']') keys += c;
  }
  return keys;
}

/// Whether a path may be the same place as another, or one around it, as `bodies[0].mass` is around
/// `bodies[curtain].mass.total`.
bool may_hold(std::string_view path, std::string_view other) {
  return (keys_of(other) + '.').starts_with(keys_of(path) + '.');
}

/// Whether the last of these assignments takes the place of the one at `early`: then a value that no place takes does
/// no harm there, and does behind all of them.
bool takes_place_of(std::vector<std::string> set, std::size_t early, SceneOverrides overrides,
                    const OpenScene& open_scene) {
  const auto is_readable = [&] {
    overrides.set = set;
    try {
      open_scene(overrides);
    } catch (const pliant::Error&) {
      return false;
    }
    return true;
  };
  const std::string unreadable = fmt::format(R"({}={{"no such key": 0}})", path_of(set[early]));
  set[early] = unreadable;
  if (!is_readable()) return false;
  set.push_back(unreadable);
  return !is_readable();
}

/// Refuses a variation in the place of an earlier one, or of a `set`, which would count for nothing. The scene has been
/// read with the values `first`.
void check_places(const SweepOptions& options, const OpenScene& open_scene, const Combination& first) {
  std::vector<std::string> set = options.overrides.set;
  for (const std::string& assignment : assignments(options.variations, first)) {
    set.push_back(assignment);
    const std::string_view path = path_of(assignment);
    for (std::size_t early = 0; early + 1 < set.size(); ++early) {
      const std::string_view other = path_of(set[early]);
      if (!may_hold(path, other) || !takes_place_of(set, early, options.overrides, open_scene)) continue;
      pliant::fail_input(
          fmt::format("--vary {}: takes the place of {} {}, which would count for nothing; leave out one "
                      "of the two",
                      pliant::printable(path), early < options.overrides.set.size() ? "--set" : "--vary",
                      pliant::printable(other)));
    }
  }
}

void check_file(const std::filesystem::path& file, std::uint32_t crc32) {
  if (pliant::crc32(pliant::read_file(file)) == crc32) return;
  pliant::fail_input(
      fmt::format("{}: has changed since the sweep began, so that its other runs could not be compared; put it back "
                  "and go on, or begin anew with --restart",
                  pliant::printable_place(file.string())));
}

void note(SweepSetup& setup, const pliant::Scene& scene) {
  setup.texts.clear();
  for (const pliant::SceneText& text : scene.source.texts) {
    setup.texts.push_back({text.file, pliant::crc32(text.text)});
  }
  for (const pliant::SceneFile& file : scene.files) setup.files[file.path] = file.crc32;
}

}  // namespace

bool varies_threads(const std::vector<Variation>& variations) {
  return std::ranges::find(variations, threads_path, &Variation::path) != variations.end();
}

SweepSetup check_sweep(const SweepOptions& options, const OpenScene& open_scene, const std::function<bool()>& goes_on) {
  SweepSetup setup;
  setup.scene = options.scene;
  setup.set = options.overrides.set;
  setup.variations = options.variations;
  setup.options = options.import;
  for (const RunOption& option : options_of(options.overrides)) {
    if (option.value) setup.options.emplace_back(option.name, *option.value);
  }
  const Combination first = product_of(options.variations).front();
  for (const Variation& variation : options.variations) check_variation(variation, options.overrides);
  note(setup, open_combination(options, open_scene, first));
  check_places(options, open_scene, first);
  for (std::size_t i = 0; i < first.size(); ++i) {
    Combination values = first;
    for (std::size_t j = 1; j < options.variations[i].values.size(); ++j) {
      if (!goes_on()) throw pliant::Error(pliant::ErrorKind::interrupted, "nothing was run");
      values[i] = options.variations[i].values[j];
      note(setup, open_combination(options, open_scene, values));
    }
  }
  return setup;
}

void check_unchanged(const SweepSetup& setup) {
  for (const TextStamp& text : setup.texts) {
    if (!text.file.empty()) check_file(text.file, text.crc32);
  }
  for (const auto& [path, crc32] : setup.files) check_file(path, crc32);
}

// Values follow their options behind '=', so that none is taken for an option. A `--` right behind a --set would only
// end its values, and a scene that begins with a dash would be an option.
std::vector<std::string> run_arguments(const SweepSetup& setup, const Combination& values,
                                       const std::filesystem::path& folder, std::int64_t threads) {
  std::vector<std::string> arguments = {"run", fmt::format("--out={}", folder.string())};
  for (const auto& [name, value] : setup.options) arguments.push_back(fmt::format("{}={}", name, value));
  if (threads >= 0) arguments.push_back(fmt::format("--threads={}", threads));
  for (const std::string& assignment : setup.set) arguments.push_back("--set=" + assignment);
  for (const std::string& assignment : assignments(setup.variations, values)) {
    arguments.push_back("--set=" + assignment);
  }
  arguments.insert(arguments.end(), {"--quiet", "--", setup.scene});
  return arguments;
}

}  // namespace pliant_sweep
