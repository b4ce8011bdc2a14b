#include "pliant_io/scene/scene_document.h"

#include <fmt/format.h>

#include "pliant_io/scene/detail/json_layout.h"
#include "pliant_io/scene/detail/resolve_scene.h"
#include "pliant_io/scene/detail/scene_merge.h"

namespace pliant {

struct SceneDocument::Content {
  explicit Content(SceneJson json) : document(std::move(json), {&origin}) {}
  Content(const Content& other) : Content(other.document.json) {}

  Origin origin{"the scene"};
  Document document;
};

namespace {

namespace fs = std::filesystem;

/// Keys that name a file where their value is a text: of meshes, maps and motions, and of animations.
bool names_file(std::string_view key, const SceneJson& value) {
  return (key == "file" || key == "frames" || key == "texture") && value.is_string();
}

std::string utf8_of(const fs::path& path) {
  const std::u8string text = path.generic_u8string();
  return {text.begin(), text.end()};
}

/// Calls change(node, value) for each name of a file. `json` is the value of the node, and may be changed.
void for_each_file(const Node& node, SceneJson& json, auto&& change) {
  if (json.is_object()) {
    for (auto& [key, value] : json.get_ref<SceneJson::object_t&>()) {
      if (names_file(key, value)) {
        change(node.require(key), value);
      } else if (value.is_structured()) {
        for_each_file(node.require(key), value, change);
      }
    }
    return;
  }
  for (std::size_t i = 0; i < json.size() && json[i].is_structured(); ++i) for_each_file(node[i], json[i], change);
}

SceneJson without_files_of_its_own(const Scene& scene) {
  SceneSource source = scene.source;
  SceneFiles files;
  const ResolvedScene resolved = resolve_scene(source, files);
  SceneJson json = resolved.document.json;
  json.erase("include");
  for_each_file(Node(resolved.document), json, [](const Node& node, SceneJson& value) {
    if (node.text().empty()) return;
    value = utf8_of(absolute_path(read_path(node)));
  });
  return json;
}

}  // namespace

SceneDocument::SceneDocument(const Scene& scene)
    : content_(std::make_unique<Content>(without_files_of_its_own(scene))) {
  // In a text of its own an entry means the body there.
  for (const auto& [path, body] : scene.implied_bodies) set(path + ".body", SceneJson(body).dump());
}

SceneDocument::~SceneDocument() = default;
SceneDocument::SceneDocument(const SceneDocument& other) : content_(std::make_unique<Content>(*other.content_)) {}
SceneDocument::SceneDocument(SceneDocument&&) noexcept = default;
SceneDocument& SceneDocument::operator=(SceneDocument other) noexcept {
  content_.swap(other.content_);
  return *this;
}

std::string SceneDocument::get(std::string_view path) const {
  const SceneJson* const found = find_value(content_->document.json, path);
  return found == nullptr ? "" : found->dump();
}

void SceneDocument::set(std::string_view path, std::string_view value) {
  const Origin origin{std::string(path)};
  const Document given(parse_json(value, path), {&origin});
  set_value(content_->document, path, Node(given));
  content_->document.origins = OriginMap{.place = SourcePlace{&content_->origin}};
}

void SceneDocument::append(std::string_view path, std::string_view value) {
  SceneJson entry = parse_json(value, path);
  const SceneJson* const found = find_value(content_->document.json, path);
  SceneJson list = found == nullptr ? SceneJson::array() : *found;
  if (!list.is_array()) fail_at(path, "", "not a list; nothing can be added to it");
  list.push_back(std::move(entry));
  set(path, list.dump());
}

void SceneDocument::remove(std::string_view path) {
  const bool is_entry = path.ends_with(']');
  const std::size_t cut = is_entry ? path.rfind('[') : path.rfind('.');
  SceneJson& root = content_->document.json;
  SceneJson* const holder = cut == path.npos ? &root : find_value(root, path.substr(0, cut));
  const std::string_view last = cut == path.npos ? path : path.substr(cut + 1);
  if (holder == nullptr) return;
  if (!is_entry && holder->is_object()) holder->erase(std::string(last));
  const SceneJson* const entry = is_entry ? find_value(root, path) : nullptr;
  if (entry != nullptr) holder->erase(static_cast<std::size_t>(entry - &holder->front()));
}

std::string SceneDocument::text(const fs::path& folder) const {
  SceneJson json = content_->document.json;
  const fs::path from = folder.empty() ? folder : absolute_path(folder);
  for_each_file(Node(content_->document), json, [&](const Node&, SceneJson& value) {
    const std::string& absolute = value.get_ref<const std::string&>();
    if (from.empty()) return;
    const fs::path near = fs::path(std::u8string(absolute.begin(), absolute.end())).lexically_relative(from);
    if (!near.empty() && *near.begin() != "..") value = utf8_of(near);
  });
  return lay_out(json) + "\n";
}

}  // namespace pliant
