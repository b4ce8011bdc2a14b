#pragma once
// The documents of a scene: its own and those that it includes, with the values that were set over them.
#include <deque>

#include "pliant_io/scene/detail/overlay.h"
#include "pliant_io/scene/detail/scene_files.h"

namespace pliant {

class SceneDocuments {
 public:
  /// Parses the first text of `source` and all that it includes. Texts that `source` does not have are read from their
  /// files, or are built-in scenes, and are added to it.
  SceneDocuments(SceneSource& source, SceneFiles& files);

  /// Each scene behind those that it includes, the scene itself last.
  std::span<SceneLayer* const> layers() const { return layers_; }
  /// The scene itself.
  Node root() const { return layers_.back()->root(); }

 private:
  /// Scenes that include each other, from the outermost on, as places in the texts.
  using Chain = std::vector<std::size_t>;

  void add_layers(std::size_t text, Chain& chain);
  void include(const Node& node, Chain& chain);
  std::size_t text_of(const Node& file);
  std::size_t read_builtin(const Node& file, const std::filesystem::path& path, const std::string& name);
  std::string chain_text(const Chain& chain) const;
  void apply_overrides();
  void set_over(std::size_t first_layer, std::string_view path, const Node& value);
  /// Puts a value over the scene that no text holds; `name` is what messages call it.
  void set(std::string name, std::string_view path, Document value);

  SceneSource& source_;
  SceneFiles& files_;
  std::deque<Document> documents_;  // deques, since nodes refer to what is in them
  std::deque<Origin> origins_;
  std::deque<SceneLayer> storage_;
  std::map<std::size_t, const Document*> parsed_;  // by text
  std::vector<SceneLayer*> layers_;
  std::size_t includes_ = 0;
};

}  // namespace pliant
