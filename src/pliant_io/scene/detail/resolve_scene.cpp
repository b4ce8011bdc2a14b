#include "pliant_io/scene/detail/resolve_scene.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pliant_io/files/read_file.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "pliant_io/scene/detail/json_values.h"
#include "pliant_io/scene/detail/renamed_keys.h"
#include "pliant_io/scene/detail/scene_merge.h"
#include "pliant_io/scene/nearest_names.h"

namespace pliant {
namespace {

constexpr std::int64_t scene_format_version = 1;
constexpr std::size_t max_include_depth = 16;
constexpr std::size_t max_includes = 256;
constexpr std::size_t max_set = 1000;

/// The value of a `--set`: JSON, or a text. What begins like a number, a list or an object is held to be meant as JSON.
SceneJson value_of(std::string_view text, std::string_view name) {
  if (is_json(text)) return parse_json(text, name);
  const bool is_number =
      text.find_first_not_of("0123456789+-.eE") == text.npos && text.find_first_of("0123456789") != text.npos;
  const bool is_container = text.starts_with('{') || text.starts_with('[') || text.starts_with('"');
  return is_number || is_container ? parse_json(text, name) : SceneJson(text);
}

std::string choice_text(auto choice) {
  return fmt::format("\"{}\"", choice_names(choice)[static_cast<std::size_t>(choice)]);
}

class SceneResolver {
 public:
  SceneResolver(SceneSource& source, SceneFiles& files) : source_(source), files_(files) {}

  ResolvedScene resolve() {
    Chain chain;
    Document document = resolve_text(0, chain);
    apply_overrides(document);
    return {std::move(origins_), std::move(document), std::move(warnings_)};
  }

 private:
  /// Scenes that include each other, from the outermost on, as places in the texts.
  using Chain = std::vector<std::size_t>;

  Document parse(std::size_t text);
  Document resolve_text(std::size_t text, Chain& chain);
  Document include(const Node& node, Chain& chain);
  std::size_t text_of(const Node& file);
  std::size_t read_builtin(const Node& file, const std::filesystem::path& path, const std::string& name);
  std::string chain_text(const Chain& chain) const;
  void apply_overrides(Document& document);
  /// Sets a value, whose key may have its old name.
  void set_over(Document& document, std::string_view path, const Node& value);
  /// Sets a value that no text holds; `name` is what messages call it.
  void set(Document& document, std::string name, std::string_view path, SceneJson value);

  SceneSource& source_;
  SceneFiles& files_;
  std::deque<Origin> origins_;  // a deque, since documents refer to them
  std::vector<std::string> warnings_;
  std::size_t includes_ = 0;
  std::size_t bytes_ = 0;  // of all texts, as often as they are included
};

Document SceneResolver::parse(std::size_t text) {
  const SceneText& given = source_.texts[text];
  const Origin& origin = origins_.emplace_back(Origin{given.name, given.folder, &files_});
  bytes_ += given.text.size();
  if (bytes_ > max_json_bytes && bytes_ > given.text.size()) {
    fail_at(given.name, "",
            fmt::format("with this one the included scenes are larger than {} MB; put meshes and maps into files of "
                        "their own",
                        max_json_bytes >> 20U));
  }
  Document document(parse_json(given.text, given.name), {&origin});
  Node(document).require_object();
  rename_old_keys(document, warnings_);
  return document;
}

Document SceneResolver::resolve_text(std::size_t text, Chain& chain) {
  Document own = parse(text);
  chain.push_back(text);
  std::optional<Document> below;
  const auto add = [&](const Node& node) {
    Document included = include(node, chain);
    if (below) {
      merge_scene(*below, std::move(included));
    } else {
      below = std::move(included);
    }
  };
  check_scene_version(Node(own));
  if (const auto included = Node(own).find("include")) {
    for (std::size_t i = 0; included->is_list() && i < included->size(); ++i) add((*included)[i]);
    if (!included->is_list()) add(*included);
  }
  chain.pop_back();
  if (!below) return own;
  merge_scene(*below, std::move(own));
  return *std::move(below);
}

Document SceneResolver::include(const Node& node, Chain& chain) {
  if (!node.is_text() && !node.is_object()) node.fail_type("the path of a scene, or {\"file\": ..., \"set\": ...}");
  if (node.is_object()) node.check_keys({"file", "set"});
  const Node file = node.is_object() ? node.require("file") : node;
  if (chain.size() >= max_include_depth) {
    file.fail(fmt::format("more than {} scenes include each other; put some into one", max_include_depth));
  }
  if (++includes_ > max_includes)
    file.fail(fmt::format("more than {} scenes are included; put some into one", max_includes));
  const std::size_t text = text_of(file);
  if (std::ranges::find(chain, text) != chain.end()) {
    file.fail(fmt::format("a scene cannot include itself: {} > {}; take one out", printable(chain_text(chain), 300),
                          printable_place(source_.texts[text].name)));
  }
  Document document = resolve_text(text, chain);
  const auto set = node.find("set");
  if (!set) return document;
  set->require_object();
  if (set->size() > max_set) set->fail(fmt::format("more than {} values are set; write a scene of your own", max_set));
  for (const std::string_view path : set->keys()) set_over(document, path, set->require(path));
  check_scene_version(Node(document));  // may be among what is set
  return document;
}

std::string SceneResolver::chain_text(const Chain& chain) const {
  std::string text;
  for (const std::size_t place : chain) text += (text.empty() ? "" : " > ") + source_.texts[place].name;
  return text;
}

/// A text that is there already counts as what it was when it was read; then come files, then built-in scenes.
std::size_t SceneResolver::text_of(const Node& file) {
  std::vector<SceneText>& texts = source_.texts;
  const std::filesystem::path path = read_path(file).lexically_normal();
  const std::filesystem::path absolute = absolute_path(path);
  const std::string name(file.text());
  const auto place_of = [&](auto&& is_meant) {
    return static_cast<std::size_t>(std::ranges::find_if(texts, is_meant) - texts.begin());
  };
  const std::size_t known = place_of([&](const SceneText& text) { return text.file == absolute; });
  if (known < texts.size()) return known;
  std::error_code ignored;
  if (!source_.is_complete && std::filesystem::is_regular_file(path, ignored)) {
    std::string text = file.locate([&] { return read_file(path); });
    texts.push_back({path.string(), path.parent_path(), std::move(text), absolute});
    return texts.size() - 1;
  }
  const std::size_t builtin = place_of(
      [&](const SceneText& text) { return text.file.empty() && text.name == name && &text != &texts.front(); });
  if (builtin < texts.size()) return builtin;
  if (source_.is_complete) file.fail("the text of this scene is not there; read the scene from its file");
  return read_builtin(file, path, name);
}

std::size_t SceneResolver::read_builtin(const Node& file, const std::filesystem::path& path, const std::string& name) {
  std::vector<std::string_view> names;
  for (const BuiltinScene& builtin : builtin_scenes()) {
    names.push_back(builtin.name);
    if (builtin.name != name) continue;
    source_.texts.push_back({name, {}, std::string(builtin.text)});
    return source_.texts.size() - 1;
  }
  std::error_code ignored;
  if (std::filesystem::symlink_status(path, ignored).type() != std::filesystem::file_type::not_found) {
    file.locate([&] { return read_file(path); });  // says what is wrong with it
  }
  file.fail(fmt::format("{}: no such file, and no built-in scene of that name; {}", printable_place(path.string()),
                        suggestion_text(name, names)));
}

void SceneResolver::set_over(Document& document, std::string_view path, const Node& value) {
  const SourcePlace place = value.place();
  const std::string name = place.path.empty() ? place.origin->name : place.origin->name + ": " + place.path;
  set_value(document, rename_old_path(path, name, warnings_), value);
  rename_old_keys(document, warnings_);
}

void SceneResolver::set(Document& document, std::string name, std::string_view path, SceneJson value) {
  const Origin& origin = origins_.emplace_back(Origin{std::move(name), source_.overrides_folder, &files_});
  const Document given(std::move(value), {&origin});
  set_over(document, path, Node(given));
}

void SceneResolver::apply_overrides(Document& document) {
  const SceneOverrides& overrides = source_.overrides;
  if (overrides.set.size() > max_set) {
    fail_at("--set", "", fmt::format("more than {} values are set; write a scene of your own", max_set));
  }
  for (const std::string& assignment : overrides.set) {
    const std::string name = "--set " + printable(assignment, 100);
    const std::size_t equals = assignment.find('=');
    if (equals == assignment.npos)
      fail_at(name, "", "there is no '='; write PATH=VALUE, such as settings.iterations=20");
    const std::string_view value = std::string_view(assignment).substr(equals + 1);
    set(document, name, std::string_view(assignment).substr(0, equals), value_of(value, name));
  }
  const auto set_typed = [&](std::string_view path, const std::string& value) {
    std::string name = fmt::format("{}={}", path, value);
    SceneJson json = parse_json(value, name);
    set(document, std::move(name), path, std::move(json));
  };
  const auto set_number = [&](std::string_view path, const auto& value) {
    if (!value) return;
    if (!std::isfinite(static_cast<Real>(*value))) {
      fail_at(fmt::format("{}={}", path, *value), "", "not a finite number; give one");
    }
    set_typed(path, fmt::format("{}", *value));
  };
  set_number("steps", overrides.steps);
  set_number("settings.time_step", overrides.time_step);
  set_number("settings.iterations", overrides.iterations);
  set_number("settings.tolerance", overrides.tolerance);
  set_number("settings.threads", overrides.threads);
  set_number("output.every", overrides.every);
  if (overrides.backend) set_typed("settings.backend", choice_text(*overrides.backend));
  if (overrides.format) set_typed("output.format", choice_text(*overrides.format));
}

}  // namespace

ResolvedScene resolve_scene(SceneSource& source, SceneFiles& files) {
  return SceneResolver(source, files).resolve();
}

void check_scene_version(const Node& root) {
  const Node version = root.require("pliant");
  if (!version.is_integer() || version.integer() != scene_format_version) {
    version.fail(fmt::format("this program reads scenes of version {} alone; write \"pliant\": {}",
                             scene_format_version, scene_format_version));
  }
}

}  // namespace pliant
