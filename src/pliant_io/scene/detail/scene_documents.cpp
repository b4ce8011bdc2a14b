#include "pliant_io/scene/detail/scene_documents.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pliant_io/files/read_file.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "pliant_io/scene/detail/json_values.h"
#include "pliant_io/scene/nearest_names.h"

namespace pliant {
namespace {

constexpr std::size_t max_depth = 16;
constexpr std::size_t max_includes = 256;
constexpr std::size_t max_set = 1000;

/// The value of a `--set`: JSON, or a text. What begins like a number, a list or an object is held to be meant as JSON.
Document value_document(std::string_view text, std::string_view name) {
  if (is_json(text)) return parse_json(text, name);
  const bool is_number =
      text.find_first_not_of("0123456789+-.eE") == text.npos && text.find_first_of("0123456789") != text.npos;
  const bool is_container = text.starts_with('{') || text.starts_with('[') || text.starts_with('"');
  return is_number || is_container ? parse_json(text, name) : text_document(text);
}

std::string choice_text(auto choice) {
  return fmt::format("\"{}\"", choice_names(choice)[static_cast<std::size_t>(choice)]);
}

}  // namespace

SceneDocuments::SceneDocuments(SceneSource& source, SceneFiles& files) : source_(source), files_(files) {
  Chain chain;
  add_layers(0, chain);
  apply_overrides();
}

void SceneDocuments::add_layers(std::size_t text, Chain& chain) {
  const Document*& document = parsed_[text];
  if (document == nullptr) {
    document = &documents_.emplace_back(parse_json(source_.texts[text].text, source_.texts[text].name));
  }
  const Document& parsed = *document;
  const Origin& origin = origins_.emplace_back(Origin{source_.texts[text].name, source_.texts[text].folder, &files_});
  const Node root(parsed, origin);
  root.require_object();
  chain.push_back(text);
  if (const auto included = root.find("include")) {
    if (included->is_list()) {
      for (std::size_t i = 0; i < included->size(); ++i) include((*included)[i], chain);
    } else {
      include(*included, chain);
    }
  }
  chain.pop_back();
  layers_.push_back(&storage_.emplace_back(SceneLayer{parsed, origin}));
}

void SceneDocuments::include(const Node& node, Chain& chain) {
  if (!node.is_text() && !node.is_object()) node.fail_type("the path of a scene, or {\"file\": ..., \"set\": ...}");
  if (node.is_object()) node.check_keys({"file", "set"});
  const Node file = node.is_object() ? node.require("file") : node;
  if (chain.size() >= max_depth) {
    file.fail(fmt::format("more than {} scenes include each other; put some into one", max_depth));
  }
  if (++includes_ > max_includes)
    file.fail(fmt::format("more than {} scenes are included; put some into one", max_includes));
  const std::size_t text = text_of(file);
  if (std::ranges::find(chain, text) != chain.end()) {
    file.fail(fmt::format("a scene cannot include itself: {} > {}; take one out", printable(chain_text(chain), 300),
                          printable_place(source_.texts[text].name)));
  }
  const std::size_t first_layer = layers_.size();
  add_layers(text, chain);
  const auto set = node.find("set");
  if (!set) return;
  set->require_object();
  if (set->size() > max_set) set->fail(fmt::format("more than {} values are set; write a scene of your own", max_set));
  for (const std::string_view path : set->keys()) set_over(first_layer, path, set->require(path));
}

std::string SceneDocuments::chain_text(const Chain& chain) const {
  std::string text;
  for (const std::size_t place : chain) text += (text.empty() ? "" : " > ") + source_.texts[place].name;
  return text;
}

/// A text that is there already counts as what it was when it was read; then come files, then built-in scenes.
std::size_t SceneDocuments::text_of(const Node& file) {
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

std::size_t SceneDocuments::read_builtin(const Node& file, const std::filesystem::path& path, const std::string& name) {
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
  file.fail(fmt::format("{}: no such file, and no built-in scene; check the path; built in are, the nearest first: {}",
                        printable_place(path.string()), nearest_names_text(name, names)));
}

void SceneDocuments::set_over(std::size_t first_layer, std::string_view path, const Node& value) {
  set_value(std::span(layers_).subspan(first_layer), path, value);
}

void SceneDocuments::set(std::string name, std::string_view path, Document value) {
  const Document& document = documents_.emplace_back(std::move(value));
  const Origin& origin = origins_.emplace_back(Origin{std::move(name), source_.overrides_folder, &files_});
  set_over(0, path, Node(document, origin));
}

void SceneDocuments::apply_overrides() {
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
    set(name, std::string_view(assignment).substr(0, equals), value_document(value, name));
  }
  const auto set_typed = [&](std::string_view path, const std::string& value) {
    std::string name = fmt::format("{}={}", path, value);
    Document document = parse_json(value, name);
    set(std::move(name), path, std::move(document));
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

}  // namespace pliant
